// The work-precision cases with a free surface. What they are compared with: free_surface_answers.h.
#include <cmath>
#include <numbers>

#include "app/free_surface_answers.h"
#include "app/work_precision.h"
#include "sim/core/parallel.h"
#include "sim/measure/diagnostics.h"

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;

double square(double x) { return x * x; }

// Area that a particle stands for at rest density, m^2.
double particle_area(const World& world) { return double{world.mass} / world.parameters().sph.rest_density; }

// --- Standing wave: 1 m deep, 2 m long, kA = 0.1 ---

constexpr double wave_depth = 1, wave_length = 2, wave_k = 2 * pi / wave_length, wave_amplitude = 0.1 / wave_k;

// Jittered: as a crystal the particles resist shear, which shortens the period by 2.8 % at 20 particles across the
// depth, with tolerances / 10 (0.1 jitter: 1.2 %, 0.25: 0.1 % too long).
Scene standing_wave(int across) {
  return scene_of(R"({"curlew": 1, "dimension": 2,
    "domain": {"min": [0, 0], "max": [2, 1.5], "periodic": [true, false]},
    "fluid": [{"box": {"min": [0, 0], "max": [2, 1]}, "jitter": 0.25}]})",
                  1.0 / across);
}

// The flat surface at its highest speed, linear theory: v = A omega sinh(ky) / sinh(kh) cos(kx).
Vec3d standing_wave_velocity(Vec3d x) {
  const double omega = 2 * pi / standing_wave_period(9.81, wave_k, wave_depth, 0);
  const double speed = wave_amplitude * omega / std::sinh(wave_k * wave_depth);
  return {-speed * std::cosh(wave_k * x.y) * std::sin(wave_k * x.x),
          speed * std::sinh(wave_k * x.y) * std::cos(wave_k * x.x), 0};
}

// Amplitude of the surface's cos(kx), m: the integral of cos(kx) over the water is that over the surface's height, in
// all orders, and no particle's place at the surface makes noise in it.
double surface_mode(const World& world) {
  return 2 / wave_length * particle_area(world) * particle_sum(world.count, [&](std::size_t i) {
           return std::cos(wave_k * double{world.fields.position[i].x});
         });
}

std::vector<double> measure_standing_wave(const Scene& scene, std::int64_t& steps) {
  PrecisionRun run(scene);
  set_velocity(run.world, standing_wave_velocity);
  const double exact = standing_wave_period(-scene.gravity.y, wave_k, wave_depth, wave_amplitude);
  Oscillation surface;
  run.simulate(5.2 * exact, [&](const World& world) { surface.add(world.time, surface_mode(world)); });
  steps = run.steps;
  return {100 * std::abs(surface.period() / exact - 1), 100 * surface.loss_per_period()};
}

// --- Square patch: 1 m wide, 1 rad/s ---

Scene square_patch(int across) {
  return scene_of(R"({"curlew": 1, "dimension": 2, "gravity": [0, 0],
    "domain": {"min": [-20, -20], "max": [20, 20]},
    "fluid": [{"box": {"min": [-0.5, -0.5], "max": [0.5, 0.5]},
               "velocity": {"field": "rotation", "centre": [0, 0], "rate": 1}}]})",
                  1.0 / across);
}

// Mean pressures of the particles while the patch has hardly turned, against the series at their places at the start;
// root mean square, as a share of the largest.
class InitialPressure {
 public:
  explicit InitialPressure(const World& world) : start_(world.count), sum_(world.count) {
    for (std::size_t i = 0; i < world.count; ++i) start_[world.fields.id[i]] = to_double(world.fields.position[i]);
  }
  void add(const World& world) {
    for (std::size_t i = 0; i < world.count; ++i) {
      sum_[world.fields.id[i]] += world.dt * double{world.fields.pressure[i]};
    }
    time_ += world.dt;
  }
  double error(double scale) const {
    double sum2 = 0;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      sum2 += square(sum_[i] / (time_ * scale) - square_patch_pressure(start_[i].x + 0.5, start_[i].y + 0.5));
    }
    return std::sqrt(sum2 / static_cast<double>(sum_.size())) / -square_patch_pressure(0.5, 0.5);
  }

 private:
  std::vector<Vec3d> start_;
  std::vector<double> sum_;
  double time_ = 0;
};

std::vector<double> measure_square_patch(const Scene& scene, std::int64_t& steps) {
  PrecisionRun run(scene, {FieldId::pressure});
  const Diagnostics start = diagnose(run.world);
  const double area = particle_area(run.world) * static_cast<double>(run.world.count);
  const auto area_error = [&] { return std::abs(covered_area(run.world) / area - 1); };
  InitialPressure pressure(run.world);
  run.simulate(0.02);
  run.simulate(0.1, [&](const World& world) { pressure.add(world); });
  while (run.world.time < 4 * pi && area_error() < 0.05) run.simulate(run.world.time + 0.05);
  const double held = run.world.time;
  run.simulate(4 * pi);
  steps = run.steps;
  const Diagnostics end = diagnose(run.world);
  return {100 * area_error(), 1e4 * std::abs(end.angular_momentum.z / start.angular_momentum.z - 1),
          100 * end.kinetic / start.kinetic, 100 * pressure.error(scene.parameters.sph.rest_density), held * 180 / pi};
}

// Pressure is negative all over, so what matters is whether the solve may pull.
std::vector<PrecisionSetting> square_patch_settings() {
  return {
      {"default", {}},
      {"tolerances / 10", {"pressure.density_tolerance=1e-5", "pressure.divergence_tolerance=1e-5"}},
      {"two-sided", {"pressure.two_sided=true", "pressure.divergence_tolerance=1e-6"}},
  };
}

// --- Oscillating drop: radius 1 m, Omega = sigma = 1/s ---

constexpr double drop_force = 1;  // Omega, 1/s

Scene oscillating_drop(int across) {
  return scene_of(R"({"curlew": 1, "dimension": 2, "gravity": [0, 0],
    "domain": {"min": [-4, -4], "max": [4, 4]},
    "fluid": [{"sphere": {"centre": [0, 0], "radius": 1}}]})",
                  2.0 / across);
}

std::vector<double> measure_oscillating_drop(const Scene& scene, std::int64_t& steps) {
  PrecisionRun run(scene);
  EllipticDrop exact;
  World& world = run.world;
  set_velocity(world, [&](Vec3d x) { return Vec3d{exact.sigma * x.x, -exact.sigma * x.y, 0}; });
  const auto pull = [&] {
    const auto kick = static_cast<float>(-drop_force * drop_force * world.dt);
    parallel_for(world.count, [&](std::size_t i) { world.fields.velocity[i] += kick * world.fields.position[i]; });
  };
  const double period = elliptic_drop_period(exact, drop_force);
  Oscillation stretching;
  double error2 = 0, time = 0;
  pull();
  run.simulate(2.5 * period, [&](const World&) {
    exact.advance(world.dt, drop_force);
    // Of an ellipse <x^2> = a^2 / 4, <y^2> = b^2 / 4.
    double xx = 0, yy = 0, xu = 0;
    for (std::size_t i = 0; i < world.count; ++i) {
      const Vec3d x = to_double(world.fields.position[i]), v = to_double(world.fields.velocity[i]);
      xx += x.x * x.x, yy += x.y * x.y, xu += x.x * v.x;
    }
    const double n = static_cast<double>(world.count);
    stretching.add(world.time, xu / xx);
    error2 += world.dt * (square(2 * std::sqrt(xx / n) - exact.a) + square(2 * std::sqrt(yy / n) - exact.b)) / 2;
    time += world.dt;
    pull();
  });
  steps = run.steps;
  return {100 * std::abs(stretching.period() / period - 1), 100 * std::sqrt(error2 / time),
          100 * stretching.loss_per_period()};
}

// --- Surge front of a dam break: column 1 m wide, 2 m high ---

constexpr double compared_time = 5.4;  // t sqrt(2 g / a)

Scene dam_break(int across) {
  return scene_of(R"({"curlew": 1, "dimension": 2, "domain": {"min": [0, 0], "max": [14, 3]},
    "fluid": [{"box": {"min": [0, 0], "max": [1, 2]}}]})",
                  1.0 / across);
}

// Farthest place that the water covers; a particle without another in reach is spray.
double front(const World& world) {
  const double farthest = particle_max(world.count, [&](std::size_t i) {
                            return world.neighbours.count(i) > 0 ? double{world.fields.position[i].x} : 0.0;
                          }).value;
  return farthest + world.scene.spacing() / 2;
}

std::vector<double> measure_dam_break(const Scene& scene, std::int64_t& steps) {
  PrecisionRun run(scene);
  const double unit = std::sqrt(2 * -scene.gravity.y);  // of time, 1/s
  std::vector<FrontPoint> curve{{0, front(run.world)}};
  run.simulate((compared_time + 1) / unit, [&](const World& world) {
    curve.push_back({world.time * unit, front(world)});
  });
  steps = run.steps;
  const double scatter = front_scatter();
  double sum2 = 0, n = 0, within = 0;
  for (const FrontSeries& series : measured_fronts()) {
    const FrontDistance d = front_distance(curve, series.points);
    sum2 += d.sum2;
    for (const double distance : d.distances) n += 1, within += std::abs(distance) <= scatter ? 1 : 0;
  }
  return {100 * std::sqrt(sum2 / n), 100 * within / n, 100 * scatter};
}

}  // namespace

std::vector<PrecisionCase> free_surface_cases() {
  return {
      {"standing_wave",
       "Standing wave, kA = 0.1, five periods",
       {"period, error (%)", "amplitude lost in a period (%)"},
       {20, 40, 80},
       usual_settings(),
       standing_wave,
       measure_standing_wave},
      {"square_patch",
       "Rotating square patch, two turns",
       {"area, error (%)", "angular momentum, drift (1e-4)", "kinetic energy kept (%)",
        "initial pressure, rms error (% of the peak)", "turn until the area is 5 % off (degrees)"},
       {20, 40, 80},
       square_patch_settings(),
       square_patch,
       measure_square_patch},
      {"oscillating_drop",
       "Drop under a central force, two and a half periods",
       {"period, error (%)", "semi-axes, rms error (% of the radius)", "amplitude lost in a period (%)"},
       {25, 50, 100},
       usual_settings(),
       oscillating_drop,
       measure_oscillating_drop},
      {"dam_break_front",
       "Surge front of a column twice as high as wide, against experiments",
       {"distance, rms (% of a)", "points within the scatter (%)", "scatter of the experiments (% of a)"},
       {20, 40, 80},
       usual_settings(),
       dam_break,
       measure_dam_break},
  };
}

}  // namespace curlew
