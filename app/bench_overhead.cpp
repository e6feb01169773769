// `curlew bench overhead`: what each turbulence method costs over plain DFSPH in flowing water, and what its passes
// cost in sweeps over the neighbours. Two copies of one state, one with the method, take their steps in turns, so that
// whatever else the machine does meets both.
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/bench.h"
#include "app/methods.h"
#include "app/progress.h"
#include "sim/core/error.h"
#include "sim/sph/motion.h"

namespace curlew {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int pairs = 5;           // of copies
constexpr int settling_steps = 3;  // a model that was off a moment ago has nothing to work on in its first step
constexpr int timed_steps = 10;

// The passes of a model and of the guard over it; vorticity counts where only confinement asks for it, as here.
constexpr const char* model_passes[] = {
    "vorticity_refinement", "vorticity_prediction", "micropolar",    "vorticity_confinement", "vorticity",
    "wavelet_energy",       "wavelet_turbulence",   "wavelet_drift", "energy_guard",          "energy_account"};

// What a model may cost, in sweeps.
double sweep_limit(const Method& m) {
  return (m.alpha > 0 ? 5 : 0) + (m.nu_t > 0 ? 2 : 0) + (m.epsilon > 0 ? 2 : 0) + (m.wavelet > 0 ? 3 : 0);
}

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// A copy of the state that takes steps, and what they cost.
struct Runner {
  World world;
  Plan plan;
  std::vector<double> ms, models, sweep;  // of each step: all of it, the models' passes, one curl of the velocity
  std::map<std::string, double> pass_ms;  // of all steps
  double pressure_iterations = 0, divergence_iterations = 0;  // of all steps

  Runner(const World& start, const Method& method, bool fixed) : world(start) {
    apply_method(world.scene.parameters, method);
    if (fixed) fix_iterations(world.scene.parameters.pressure);
    plan = make_plan(world);
    prepare(world, plan);
    allocate(world, make_plan(world, {FieldId::vorticity}));
    for (int k = 0; k < settling_steps; ++k) step(world, plan);
  }

  void take_step() {
    PassTimes passes;
    const auto begin = Clock::now();
    step(world, plan, &passes);
    ms.push_back(milliseconds_since(begin));
    models.push_back(0);
    for (const char* name : model_passes) {
      pass_ms[name] += passes.ms[name];
      models.back() += passes.ms[name];
    }
    pressure_iterations += world.report.pressure_iterations;
    divergence_iterations += world.report.divergence_iterations;
    time_sweep();
  }

  // Over the lists that the step left.
  void time_sweep() {
    const auto begin = Clock::now();
    compute_vorticity(world);
    sweep.push_back(milliseconds_since(begin));
  }
};

// A method beside DFSPH, a number for each pair of copies.
struct Comparison {
  std::vector<double> ratio, ms, plain_ms, models, sweeps, sweep_ms;
  std::map<std::string, double> pass_ms;  // a step
  double iterations[2] = {}, plain_iterations[2] = {};

  void add(const Runner& plain, const Runner& with) {
    ms.push_back(median(with.ms));
    plain_ms.push_back(median(plain.ms));
    ratio.push_back(ms.back() / plain_ms.back());
    models.push_back(median(with.models));
    sweep_ms.push_back(median(with.sweep));
    sweeps.push_back(models.back() / sweep_ms.back());
    constexpr double steps = double{pairs} * timed_steps;
    for (const auto& [name, total] : with.pass_ms) pass_ms[name] += total / steps;
    iterations[0] += with.pressure_iterations / steps;
    iterations[1] += with.divergence_iterations / steps;
    plain_iterations[0] += plain.pressure_iterations / steps;
    plain_iterations[1] += plain.divergence_iterations / steps;
  }
};

World flowing_water(const Scene& scene, double time) {
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  Progress progress(false);
  while (world.time < time) {
    step(world, plan);
    progress.show(std::min(1.0, world.time / time), "the state to measure in");
  }
  return world;
}

std::vector<Comparison> compare(const World& start, const std::vector<Method>& methods, bool fixed) {
  std::vector<Comparison> all(methods.size());
  Progress progress(false);
  for (int pair = 0; pair < pairs; ++pair) {
    for (std::size_t k = 0; k < methods.size(); ++k) {
      Runner plain(start, {}, fixed), with(start, methods[k], fixed);
      for (int n = 0; n < timed_steps; ++n) {
        (n % 2 == 0 ? plain : with).take_step();
        (n % 2 == 0 ? with : plain).take_step();
      }
      all[k].add(plain, with);
      const double done = pair + static_cast<double>(k + 1) / static_cast<double>(methods.size());
      progress.show(done / pairs, (fixed ? "fixed iterations, " : "to tolerance, ") + method_label(methods[k]));
    }
  }
  return all;
}

std::string range_text(const std::vector<double>& ratios) {
  const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
  char text[80];
  const auto more = [](double ratio) { return 100 * (ratio - 1); };
  std::snprintf(text, sizeof text, "%+.1f %% (%+.1f to %+.1f)", more(median(ratios)), more(*low), more(*high));
  return text;
}

void print_times(const char* title, const std::vector<Method>& methods, const std::vector<Comparison>& all) {
  std::printf("\n%s:\n\n", title);
  std::printf("| method | DFSPH, ms a step | with it | more time, median (range) | iterations | DFSPH's |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Comparison& c = all[k];
    std::printf("| %s | %.1f | %.1f | %s | %.1f + %.1f | %.1f + %.1f |\n", method_label(methods[k]).c_str(),
                median(c.plain_ms), median(c.ms), range_text(c.ratio).c_str(), c.iterations[0], c.iterations[1],
                c.plain_iterations[0], c.plain_iterations[1]);
  }
}

void print_sweeps(const std::vector<Method>& methods, const std::vector<Comparison>& all) {
  std::vector<double> sweeps;
  for (const Comparison& c : all) sweeps.insert(sweeps.end(), c.sweep_ms.begin(), c.sweep_ms.end());
  std::printf(
      "\nThe models' passes, at fixed iterations; one curl of the velocity over the same lists takes %.2f ms:\n\n",
      median(sweeps));
  std::printf(
      "| method | ms a step, median | in curls, median | at most | pass by pass, mean ms |\n|---|---|---|---|---|\n");
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::printf("| %s | %.2f | %.2f | %g |", method_label(methods[k]).c_str(), median(all[k].models),
                median(all[k].sweeps), sweep_limit(methods[k]));
    const char* separator = " ";
    for (const char* name : model_passes) {
      if (!(all[k].pass_ms.at(name) > 0)) continue;
      std::printf("%s%s %.2f", separator, name, all[k].pass_ms.at(name));
      separator = ", ";
    }
    std::printf(" |\n");
  }
}

}  // namespace

int bench_overhead(const BenchOptions& options) {
  check_free(options.settings, {});
  std::vector<Method> methods = parse_methods(
      options.methods.empty() ? std::vector<std::string>{"vc0.1", "mp0.05", "vr1.0", "sum1.0", "vr1.0+mp0.05"}
                              : options.methods);
  std::erase(methods, Method{});
  if (methods.empty())
    throw InputError("--methods names dfsph alone, which the others are compared with; name another");
  const Scene scene = bench_scene("dam_break", 0, single_case(options, "97k"), options);
  const World start = flowing_water(scene, options.time.value_or(0.4));
  std::printf("dam_break, %zu particles, viscosity.nu = %g, from the state at %.2f s, %d threads, %s\n", start.count,
              scene.parameters.viscosity.nu, start.time, omp_get_max_threads(), CURLEW_ISA_NAME);
  const std::vector<Comparison> fixed = compare(start, methods, true);
  print_times("13 + 2 iterations for all", methods, fixed);
  print_times("To tolerance", methods, compare(start, methods, false));
  print_sweeps(methods, fixed);
  return 0;
}

}  // namespace curlew
