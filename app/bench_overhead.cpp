// `curlew bench overhead`: what each turbulence method costs over plain DFSPH in flowing water, and what its passes
// cost in sweeps over the neighbours. Each method is timed beside DFSPH from a copy of the same state, in turns, so
// that whatever else the machine does meets both.
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/bench.h"
#include "app/methods.h"
#include "app/progress.h"
#include "sim/sph/motion.h"

namespace curlew {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int pairs = 5;
constexpr int settling_steps = 3;  // a model that was off a moment ago has nothing to work on in its first step
constexpr int timed_steps = 10;
constexpr int sweep_repeats = 7;

// The passes of a model; vorticity counts where only confinement asks for it, as here.
constexpr const char* model_passes[] = {
    "vorticity_refinement", "vorticity_prediction", "micropolar", "spin", "vorticity_confinement", "vorticity"};

// What a model may cost, in sweeps.
double sweep_limit(const Method& m) { return (m.alpha > 0 ? 5 : 0) + (m.nu_t > 0 ? 2 : 0) + (m.epsilon > 0 ? 2 : 0); }

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

struct Timing {
  double ms = 0, models = 0, sweep = 0;  // ms: of a step, of the models' passes in it, of one curl of the velocity
  double pressure_iterations = 0, divergence_iterations = 0;  // of a step
  PassTimes passes;
};

// One curl of the velocity over the lists that the last step left.
double sweep_time(World& world) {
  allocate(world, make_plan(world, {FieldId::vorticity}));
  std::vector<double> times;
  for (int k = 0; k < sweep_repeats; ++k) {
    const auto begin = Clock::now();
    compute_vorticity(world);
    times.push_back(milliseconds_since(begin));
  }
  return median(times);
}

Timing measure(const World& start, const Method& method, bool fixed) {
  World world = start;
  apply_method(world.scene.parameters, method);
  if (fixed) fix_iterations(world.scene.parameters.pressure);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  for (int k = 0; k < settling_steps; ++k) step(world, plan);
  Timing timing;
  const auto begin = Clock::now();
  for (int k = 0; k < timed_steps; ++k) {
    step(world, plan, &timing.passes);
    timing.pressure_iterations += world.report.pressure_iterations / double{timed_steps};
    timing.divergence_iterations += world.report.divergence_iterations / double{timed_steps};
  }
  timing.ms = milliseconds_since(begin) / timed_steps;
  for (const char* name : model_passes) timing.models += timing.passes.ms[name] / timed_steps;
  timing.sweep = sweep_time(world);
  return timing;
}

// A method beside DFSPH, over all pairs.
struct Comparison {
  std::vector<double> ratio, ms, plain_ms, models, sweeps, sweep_ms;
  Timing last, last_plain;  // of the last pair, for the iterations

  void add(const Timing& plain, const Timing& with) {
    ratio.push_back(with.ms / plain.ms);
    ms.push_back(with.ms);
    plain_ms.push_back(plain.ms);
    models.push_back(with.models);
    // Both sweeps are of the same cost; their mean stands nearer to the time at which the passes were measured.
    sweep_ms.push_back((with.sweep + plain.sweep) / 2);
    sweeps.push_back(with.models / sweep_ms.back());
    last = with, last_plain = plain;
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
      // The order turns over, so that a machine that slows down or speeds up does not favour one of the two.
      const bool plain_first = pair % 2 == 0;
      const Timing first = measure(start, plain_first ? Method{} : methods[k], fixed);
      const Timing second = measure(start, plain_first ? methods[k] : Method{}, fixed);
      all[k].add(plain_first ? first : second, plain_first ? second : first);
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
                median(c.plain_ms), median(c.ms), range_text(c.ratio).c_str(), c.last.pressure_iterations,
                c.last.divergence_iterations, c.last_plain.pressure_iterations, c.last_plain.divergence_iterations);
  }
}

void print_sweeps(const std::vector<Method>& methods, const std::vector<Comparison>& all) {
  std::vector<double> sweeps;
  for (const Comparison& c : all) sweeps.insert(sweeps.end(), c.sweep_ms.begin(), c.sweep_ms.end());
  std::printf(
      "\nThe models' passes, at fixed iterations; one curl of the velocity over the same lists takes %.2f ms:\n\n",
      median(sweeps));
  std::printf("| method | passes, ms a step | in curls, median | limit | pass by pass, ms |\n|---|---|---|---|---|\n");
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::printf("| %s | %.2f | %.2f | %g |", method_label(methods[k]).c_str(), median(all[k].models),
                median(all[k].sweeps), sweep_limit(methods[k]));
    const char* separator = " ";
    for (const char* name : model_passes) {
      const auto& ms = all[k].last.passes.ms;
      if (const auto found = ms.find(name); found != ms.end() && found->second > 0) {
        std::printf("%s%s %.2f", separator, name, found->second / timed_steps);
        separator = ", ";
      }
    }
    std::printf(" |\n");
  }
}

}  // namespace

int bench_overhead(const BenchOptions& options) {
  check_free(options.settings, {});
  std::vector<Method> methods = parse_methods(
      options.methods.empty() ? std::vector<std::string>{"vc0.1", "mp0.05", "vr1.0", "poisson1.0", "vr1.0+mp0.05"}
                              : options.methods);
  std::erase(methods, Method{});
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
