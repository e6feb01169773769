// The cases of the work-precision bench, each against its exact answer; those with a free surface are in
// precision_free_surface.cpp.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/accuracy.h"
#include "app/work_precision.h"
#include "sim/core/parallel.h"
#include "sim/measure/diagnostics.h"
#include "sim/measure/vortex.h"

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;

// What converges in the second order for vortices: solves that leave less than is usual.
PrecisionSetting accurate() {
  return {"accurate", {"pressure.density_tolerance=1e-5", "pressure.relative_tolerance=0.1"}};
}

// Taylor-Green vortices: u = -U e^(bt) cos X sin Y, v = U e^(bt) sin X cos Y, X = 2 pi x / L, b = -8 pi^2 nu / L^2;
// nu in m^2/s.
Scene taylor_green(int across, const std::string& nu) {
  return scene_of(R"({"curlew": 1, "dimension": 2, "gravity": [0, 0],
    "domain": {"min": [0, 0], "max": [1, 1], "periodic": [true, true]},
    "fluid": [{"box": {"min": [0, 0], "max": [1, 1]}, "velocity": {"field": "taylor_green"}, "jitter": 0.25}],
    "parameters": {"pressure.two_sided": true, "viscosity.nu": )" +
                      nu + "}}",
                  1.0 / across);
}

std::vector<double> measure_taylor_green(const Scene& scene, std::int64_t& steps) {
  PrecisionRun run(scene);
  InitialVelocity exact = scene.fluid[0].velocity;
  const double rate = -8 * pi * pi * scene.parameters.viscosity.nu;
  // Least squares of ln E = ln E_0 + 2 b t over all steps.
  double n = 0, st = 0, se = 0, stt = 0, ste = 0;
  run.simulate(1, [&](const World& world) {
    const double t = world.time, e = std::log(kinetic_energy(world));
    n += 1, st += t, se += e, stt += t * t, ste += t * e;
  });
  steps = run.steps;
  const double measured = (n * ste - st * se) / (n * stt - st * st) / 2;
  exact.speed = std::exp(rate * run.world.time);
  return {100 * velocity_error(run.world, exact, {}, 1e9), 100 * (measured / rate - 1),
          100 * (flow_amplitude(run.world, exact) - 1)};
}

// Flow between plates 1 m apart, 1.6 m of it (four supports of the widest kernel at 10 particles), with nu = 1 m^2/s,
// at the Reynolds number 0.0125 of Morris et al. (1997, section 4).
constexpr double plate_speed = 0.0125;
constexpr double start_up_times[] = {0.0225, 0.045, 0.1125, 0.225, 1};  // s

Scene channel(int across, const std::string& gravity, const std::string& upper) {
  return scene_of(R"({"curlew": 1, "dimension": 2, "gravity": [)" + gravity + R"(, 0],
    "domain": {"min": [0, 0], "max": [1.6, 1], "periodic": [true, false],
      "walls": {"y-": "no-slip", "y+": {"kind": "no-slip", "velocity": [)" +
                      upper + R"(, 0]}}},
    "fluid": [{"box": {"min": [0, 0], "max": [1.6, 1]}}],
    "parameters": {"viscosity.nu": 1, "pressure.two_sided": true}})",
                  1.0 / across);
}
Scene couette(int across) { return channel(across, "0", "0.0125"); }
Scene poiseuille(int across) { return channel(across, "0.1", "0"); }  // its peak is g / 8 nu

double couette_speed(double y, double t) {
  double u = plate_speed * y;
  for (int n = 1; n < 100; ++n) {
    u += 2 * plate_speed / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * t);
  }
  return u;
}
double poiseuille_speed(double y, double t) {
  double u = 4 * plate_speed * y * (1 - y);
  for (int n = 1; n < 200; n += 2) {
    u -= 32 * plate_speed / (pi * pi * pi * n * n * n) * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * t);
  }
  return u;
}

std::vector<double> measure_channel(const Scene& scene, std::int64_t& steps, double (*exact)(double, double)) {
  PrecisionRun run(scene);
  double worst = 0, at_end = 0;
  for (const double time : start_up_times) {
    run.simulate(time);
    const World& world = run.world;
    at_end = 0;
    for (std::size_t i = 0; i < world.count; ++i) {
      const double u = exact(double{world.fields.position[i].y}, world.time);
      at_end = std::max(at_end, std::abs(double{world.fields.velocity[i].x} - u) / plate_speed);
    }
    worst = std::max(worst, at_end);
  }
  steps = run.steps;
  return {100 * worst, 100 * at_end};
}

// A tank of water at rest, 1 m deep.
Scene tank(int across) {
  return scene_of(R"({"curlew": 1, "dimension": 2, "domain": {"min": [0, 0], "max": [1, 1.5]},
    "fluid": [{"box": {"min": [0, 0], "max": [1, 1]}}], "parameters": {"viscosity.nu": 0.01}})",
                  1.0 / across);
}

std::vector<double> measure_tank(const Scene& scene, std::int64_t& steps) {
  PrecisionRun run(scene, {FieldId::pressure});
  run.simulate(3);
  const double rest = scene.parameters.sph.rest_density, g = -scene.gravity.y;
  double pressure = 0, exact = 0, speed = 0;
  run.simulate(4, [&](const World& world) {
    pressure += world.dt * particle_sum(world.count, [&](std::size_t i) { return double{world.fields.pressure[i]}; });
    exact += world.dt * particle_sum(world.count, [&](std::size_t i) {
               return rest * g * (1 - double{world.fields.position[i].y});
             });
    speed =
        std::max(speed, std::sqrt(2 * kinetic_energy(world) / (double{world.mass} * static_cast<double>(world.count))));
  });
  steps = run.steps;
  return {100 * std::abs(pressure / exact - 1), 100 * speed / std::sqrt(g)};
}

std::vector<PrecisionCase> first_cases() {
  return {
      {"taylor_green",
       "Taylor-Green vortices, Re 100, t = 1 s",
       {"L1 velocity error (%)", "decay rate, error (%)", "amplitude, error (%)"},
       {25, 50, 100},
       with(with(usual_settings(), {"vector form", {"viscosity.form=vector"}}), accurate()),
       [](int across) { return taylor_green(across, "0.01"); },
       measure_taylor_green},
      {"taylor_green_1000",
       "Taylor-Green vortices, Re 1000, t = 1 s",
       {"L1 velocity error (%)", "decay rate, error (%)", "amplitude, error (%)"},
       {25, 50, 100},
       {{"default", {}}, accurate()},
       [](int across) { return taylor_green(across, "0.001"); },
       measure_taylor_green},
      {"couette",
       "Couette flow, start-up, Re 0.0125",
       {"largest error (% of the plate)", "in the end (%)"},
       {10, 20, 30},
       with(usual_settings(), {"vector form", {"viscosity.form=vector"}}),
       couette,
       [](const Scene& s, std::int64_t& steps) { return measure_channel(s, steps, couette_speed); }},
      {"poiseuille",
       "Poiseuille flow, start-up, Re 0.0125",
       {"largest error (% of the peak)", "in the end (%)"},
       {10, 20, 30},
       with(usual_settings(), {"vector form", {"viscosity.form=vector"}}),
       poiseuille,
       [](const Scene& s, std::int64_t& steps) { return measure_channel(s, steps, poiseuille_speed); }},
      {"hydrostatic",
       "Water at rest, pressure over 1 s",
       {"mean pressure, error (%)", "rms speed (% of sqrt(g H))"},
       {20, 40, 80},
       usual_settings(),
       tank,
       measure_tank},
  };
}

}  // namespace

const std::vector<PrecisionCase>& precision_cases() {
  static const std::vector<PrecisionCase> cases = [] {
    std::vector<PrecisionCase> all = first_cases();
    for (PrecisionCase& c : free_surface_cases()) all.push_back(std::move(c));
    return all;
  }();
  return cases;
}

}  // namespace curlew
