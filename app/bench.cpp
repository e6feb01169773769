// `curlew bench speed` and `curlew bench memory`: the dam break of the README's tables, measured.
#include <omp.h>

#include <chrono>
#include <cstdio>
#include <map>

#include "app/accuracy.h"
#include "app/assets.h"
#include "app/commands.h"
#include "app/numbers.h"
#include "app/progress.h"
#include "app/setup.h"
#include "sim/core/error.h"
#include "sim/core/passes.h"
#include "sim/scene/bundled.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

using Clock = std::chrono::steady_clock;

// Resolutions and simulated times of the comparison in the README; larger cases run a few steps.
struct Case {
  std::string particles;
  double time;  // s
};
constexpr double largest_time = 0.1;

Case named_case(const std::string& text) {
  parse_particle_number("--cases", text);  // so that a wrong one is told before the first is run
  if (text == "24k") return {text, 1.0};
  if (text == "97k") return {text, 0.5};
  return {text, largest_time};
}

struct PassTimes : PassObserver {
  std::map<std::string, double> ms;
  void after(const Pass& pass, const World&, double milliseconds) override {
    ms[std::string(pass.name)] += milliseconds;
  }
};

struct Measured {
  std::size_t particles = 0;
  double steps = 0, seconds = 0, simulated = 0, pressure_iterations = 0, divergence_iterations = 0;
  double density_error_true = 0, pair_visits = 0, sweeps = 0, bytes = 0, within_tolerance = 0;
  PassTimes passes;

  double rate() const { return 1e-6 * static_cast<double>(particles) * steps / seconds; }
  double per_step(double total) const { return total / steps; }
};

Scene case_scene(const Case& c, const BenchOptions& options) {
  Scene scene = read_scene(find_scene("dam_break", assets_folder()));
  scene.parameters.viscosity.nu = 0.01;
  apply_settings(scene.parameters, options.settings);
  return with_particles(scene, parse_particle_number("--cases", c.particles));
}

Measured measure(const Scene& scene, double time, std::int64_t most_steps, const std::string& label) {
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  world.work = {};
  Measured m;
  m.particles = world.count;
  Progress progress(false);
  while (world.time < time && world.step < most_steps) {
    const auto begin = Clock::now();
    step(world, plan, &m.passes);
    m.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    const StepReport& r = world.report;
    m.pressure_iterations += r.pressure_iterations;
    m.divergence_iterations += r.divergence_iterations;
    m.density_error_true += r.density_error_true_avg;
    const PressureParameters& p = world.parameters().pressure;
    m.within_tolerance += r.density_error_avg <= p.density_tolerance && r.divergence_error <= p.divergence_tolerance;
    progress.show(std::max(world.time / time, static_cast<double>(world.step) / static_cast<double>(most_steps)),
                  label);
  }
  m.steps = static_cast<double>(world.step);
  m.simulated = world.time;
  m.pair_visits = static_cast<double>(world.work.pair_visits);
  m.sweeps = static_cast<double>(world.work.sweeps);
  m.bytes = static_cast<double>(allocated_bytes(world)) / static_cast<double>(m.particles);
  return m;
}

constexpr std::int64_t no_limit = 1000000000;

void print_case(const char* work, const Measured& m) {
  std::printf("| %s | %zu | %.2f s | %.0f | %.2f ms | %.1f + %.1f | %.1f | %.2f M | %.2f | %.1f | %.2g | %.1f %% |\n",
              work, m.particles, m.simulated, m.steps, 1e3 * m.simulated / m.steps, m.per_step(m.pressure_iterations),
              m.per_step(m.divergence_iterations), 1e3 * m.seconds / m.steps, m.rate(), 1e9 * m.seconds / m.pair_visits,
              m.seconds / m.simulated, m.per_step(m.density_error_true), 100 * m.per_step(m.within_tolerance));
}

void print_passes(const std::vector<Measured>& all) {
  std::printf("\nMilliseconds a step by pass:\n\n| pass |");
  for (const Measured& m : all) std::printf(" %zu |", m.particles);
  std::printf("\n|---|");
  for (std::size_t k = 0; k < all.size(); ++k) std::printf("---|");
  std::printf("\n");
  for (const Pass& pass : pass_table()) {
    const std::string name(pass.name);
    if (!all.front().passes.ms.contains(name)) continue;
    std::printf("| %s |", name.c_str());
    for (const Measured& m : all) std::printf(" %.2f |", m.per_step(m.passes.ms.at(name)));
    std::printf("\n");
  }
}

int speed(const BenchOptions& options, const std::vector<Case>& cases) {
  std::printf("dam_break, viscosity.nu = 0.01, %d threads, %s\n\n", omp_get_max_threads(), CURLEW_ISA_NAME);
  std::printf(
      "| work | particles | simulated | steps | mean dt | iterations | ms a step | particle-steps a second | ns a "
      "pair visit | s a simulated second | mean true compression | steps within tolerance |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<Measured> all;
  bool fast_enough = true;
  for (const Case& c : cases) {
    const Scene scene = case_scene(c, options);
    all.push_back(measure(scene, c.time * options.time_share, no_limit, c.particles));
    print_case("to tolerance", all.back());
    fast_enough = fast_enough && !(options.at_least && all.back().rate() < *options.at_least);
    Scene fixed = scene;
    PressureParameters& p = fixed.parameters.pressure;
    p.max_iterations = 13;
    p.max_divergence_iterations = 2;
    p.density_tolerance = p.divergence_tolerance = 1e-7;
    print_case("fixed 13 + 2", measure(fixed, c.time, 20, c.particles + " fixed"));
  }
  print_passes(all);
  if (!fast_enough) std::printf("\na case made fewer than %g million particle-steps a second\n", *options.at_least);
  return fast_enough ? 0 : 1;
}

int memory(const BenchOptions& options, const std::vector<Case>& cases) {
  std::printf("| particles | body samples | solver bytes a particle | after 20 steps |\n|---|---|---|---|\n");
  for (const Case& c : cases) {
    World world = make_world(case_scene(c, options));
    const Plan plan = make_plan(world);
    prepare(world, plan);
    const auto bytes = [&] { return static_cast<double>(allocated_bytes(world)) / static_cast<double>(world.count); };
    const double before = bytes();
    for (int k = 0; k < 20; ++k) step(world, plan);
    std::printf("| %zu | %zu | %.0f | %.0f |\n", world.count, world.bodies.count(), before, bytes());
  }
  return 0;
}

}  // namespace

int bench_command(const BenchOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  if (options.name == "accuracy") return accuracy_bench(options);
  if (!options.names.empty())
    throw InputError("curlew bench " + options.name + " takes no case, found \"" + options.names[0] + "\"");
  std::vector<Case> cases;
  for (const std::string& text : options.cases) cases.push_back(named_case(text));
  if (cases.empty()) cases = {named_case("24k"), named_case("97k")};
  return options.name == "speed" ? speed(options, cases) : memory(options, cases);
}

}  // namespace curlew
