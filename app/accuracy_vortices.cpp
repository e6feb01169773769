// Vortices that a fluid without viscosity keeps for ever: what each method has left after one turn.
//
//   gresho_chan    Gresho & Chan 1990: after one turn of the peak
//   lamb_oseen     after one turn of the peak; velocity errors within 5 core radii, where the mirrored vortices, 20
//   core
//                  radii away, change the velocity by less than 1 %
//   taylor_vortex  the four vortices of taylor_green without viscosity, after one turn of their centres; one wave
//                  number only, so that the growth rate of the micropolar model is exact here
//
// Kinetic energy counts from the first step on, whose pressure takes the flow between the squares out of lamb_oseen.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/accuracy.h"
#include "app/progress.h"
#include "sim/core/error.h"
#include "sim/core/passes.h"
#include "sim/measure/diagnostics.h"
#include "sim/measure/vortex.h"
#include "sim/scene/sampling.h"

namespace curlew {
namespace {

constexpr double no_limit = 1e30;
constexpr double tau = 2 * std::numbers::pi;

struct VortexCase {
  std::string name;
  Scene scene;
  double turn = 0;           // s
  double profile_reach = 0;  // m; 0: no one centre, the peak is the share of the exact flow that is there
  double error_reach = 0;    // m, from the centre
  double wave_number = 0;    // 1/m, of the exact flow: sqrt(int |curl v|^2 / int |v|^2); 0: not known

  InitialVelocity exact() const { return scene.fluid.at(0).velocity; }
};

struct VortexResult {
  std::vector<ProfileRing> profile;
  double peak = 0, error = 0, energy = 0;  // as shares of what is exact
  double joule = 0;                        // kinetic energy at the end
  double wave_number = 0;                  // at the start, 1/m
  double seconds = 0;                      // wall time of the steps
  double time = 0;                         // s, at the end
  std::int64_t steps = 0;
  std::string diverged;
};

double start_wave_number(World& world) {
  prepare(world, make_plan(world, {FieldId::vorticity}));
  return wave_number(world);
}

void simulate(World& world, double time, const std::string& label, VortexResult& r) {
  using Clock = std::chrono::steady_clock;
  const Plan plan = make_plan(world);
  prepare(world, plan);
  Progress progress(false);
  double start = 0;
  while (world.time < time) {
    const auto begin = Clock::now();
    step(world, plan);
    r.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    if (world.step == 1) start = kinetic_energy(world);
    progress.show(world.time / time, label);
  }
  r.joule = kinetic_energy(world);
  r.energy = r.joule / start;
}

VortexResult measure(const VortexCase& c, const AccuracyMethod& method, double share) {
  World world = make_world(with_method(c.scene, method));
  VortexResult r;
  r.wave_number = start_wave_number(world);
  try {
    simulate(world, c.turn * share, c.name + ", " + method.name, r);
  } catch (const DivergedError& error) {
    r.diverged = error.what();
  }
  const InitialVelocity exact = c.exact();
  if (c.profile_reach > 0) r.profile = azimuthal_profile(world, exact, world.scene.spacing(), c.profile_reach);
  r.peak = r.profile.empty() ? flow_amplitude(world, exact) : peak_retained(r.profile);
  r.error = velocity_error(world, exact, exact.centre, c.error_reach);
  r.steps = world.step;
  r.time = world.time;
  return r;
}

std::vector<std::string> row_of(const AccuracyMethod& method, const VortexResult& r) {
  if (!r.diverged.empty())
    return {method.name, "diverged", "", "", std::to_string(r.steps), formatted("%.2f", r.seconds)};
  return {method.name,
          formatted("%.3f", r.peak),
          formatted("%.4f", r.error),
          formatted("%.3f", r.energy),
          std::to_string(r.steps),
          formatted("%.2f", r.seconds)};
}

// What the micropolar model adds to plain DFSPH, beside what its eigenvalue says.
void print_micropolar(const VortexCase& c, const AccuracyMethod& method, const VortexResult& plain,
                      const VortexResult& r) {
  const MicropolarParameters p = with_method(c.scene, method).parameters.micropolar;
  std::printf(
      "%s over DFSPH after %.3f s: peak %.3f times, kinetic energy %.3f times. On paper a wave k without spin at "
      "the start, of the k\n",
      method.name.c_str(), r.time, r.peak / plain.peak, r.joule / plain.joule);
  const auto say = [&](const char* whose, double k) {
    const double growth = micropolar_growth(p, k, r.time);
    std::printf("  that %s, %.2f 1/m, with the growth rate %.3f 1/s: %.3f times, its energy %.3f times\n", whose, k,
                micropolar_growth_rate(p, k), growth, growth * growth);
  };
  say("the sums over neighbours see", r.wave_number);
  if (c.wave_number > 0) say("is exact", c.wave_number);
}

void run_case(const VortexCase& c, const BenchOptions& options) {
  const double per_metre = std::round(1 / c.scene.spacing());
  std::printf("\n%s: %.0f particles a metre, one turn (%.3f s)\n\n", c.name.c_str(), per_metre,
              c.turn * options.time_share);
  AccuracyTable table{{"method", "peak retained", "L1 velocity error", "kinetic energy retained", "steps", "wall s"},
                      {}};
  AccuracyTable profile{{"method", "r", "v", "v_exact"}, {}};
  std::vector<VortexResult> results;
  for (const AccuracyMethod& method : accuracy_methods()) {
    results.push_back(measure(c, method, options.time_share));
    table.rows.push_back(row_of(method, results.back()));
    for (const ProfileRing& ring : results.back().profile) {
      profile.rows.push_back({method.name, formatted("%.6g", ring.radius), formatted("%.6g", ring.measured),
                              formatted("%.6g", ring.exact)});
    }
  }
  table.print();
  std::printf("\n");
  for (std::size_t k = 0; k < results.size(); ++k) {
    const AccuracyMethod& method = accuracy_methods()[k];
    if (method.name.starts_with("MP")) print_micropolar(c, method, results.front(), results[k]);
    if (!results[k].diverged.empty()) std::printf("%s: %s\n", method.name.c_str(), results[k].diverged.c_str());
  }
  const std::string name = "accuracy_" + c.name + "_" + formatted("%.0f", per_metre);
  table.write(name, options);
  if (!profile.rows.empty()) profile.write(name + "_profile", options);
}

}  // namespace

void gresho_chan_accuracy(const BenchOptions& options) {
  for (const Scene& scene : accuracy_scenes("gresho_chan", options)) {
    const InitialVelocity v = scene.fluid.at(0).velocity;
    // Over the rings of the profile int |curl v|^2 = 2 pi 4 ln 2 U^2 and int |v|^2 = 2 pi (2/3) U^2 R^2.
    const double k = std::sqrt(6 * std::numbers::ln2) / v.radius;
    run_case({"gresho_chan", scene, tau * v.radius / v.speed, 2.5 * v.radius, no_limit, k}, options);
  }
}

void lamb_oseen_accuracy(const BenchOptions& options) {
  for (const Scene& scene : accuracy_scenes("lamb_oseen", options)) {
    const InitialVelocity v = scene.fluid.at(0).velocity;
    const double peak = 1.12091 * v.radius;  // where d/dr (1 - exp(-r^2/a^2)) / r = 0
    run_case({"lamb_oseen", scene, tau * peak / azimuthal_speed(v, peak), 9 * v.radius, 5 * v.radius, 0}, options);
  }
}

void taylor_vortex_accuracy(const BenchOptions& options) {
  for (Scene scene : accuracy_scenes("taylor_green", options)) {
    scene.parameters.viscosity.nu = 0;
    // The centres turn at half their vorticity, 2 pi U / L.
    const double turn = (scene.domain.max.x - scene.domain.min.x) / scene.fluid.at(0).velocity.speed;
    const double k = std::numbers::sqrt2 * tau / (scene.domain.max.x - scene.domain.min.x);
    run_case({"taylor_vortex", scene, turn, 0, no_limit, k}, options);
  }
}

}  // namespace curlew
