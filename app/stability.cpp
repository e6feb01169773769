#include "app/stability.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "sim/core/error.h"
#include "sim/core/passes.h"
#include "sim/measure/diagnostics.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

const StabilityAxis& axis(const std::string& name) {
  const auto& all = stability_axes();
  return *std::find_if(all.begin(), all.end(), [&](const StabilityAxis& a) { return a.name == name; });
}

StabilityMap line(const std::string& name, std::vector<double> values, StabilityPoint base = {},
                  const std::string& fixed = "") {
  return {name, &axis(name), nullptr, std::move(values), {0}, base, fixed};
}

StabilityMap plane(const std::string& x, std::vector<double> xs, const std::string& y, std::vector<double> ys) {
  return {x + "_x_" + y, &axis(x), &axis(y), std::move(xs), std::move(ys), {}, ""};
}

// The mean over the last part, each state weighed with its step.
class LastPart {
 public:
  explicit LastPart(double end) : begin_(end - last_part) {}
  void add(double time, double dt, double value) {
    if (time > begin_) sum_ += dt * value, width_ += dt;
  }
  double mean() const { return width_ > 0 ? sum_ / width_ : NAN; }

 private:
  double begin_, sum_ = 0, width_ = 0;
};

}  // namespace

const std::vector<StabilityAxis>& stability_axes() {
  using P = StabilityPoint;
  static const std::vector<StabilityAxis> axes = {
      {"alpha", "refinement, α (1)", &P::alpha, 1.3, "α from 1.3 on is unstable"},
      {"nu_t", "micropolar, ν_t (m²/s)", &P::nu_t, 0.2, "with ν_t from 0.2 m²/s on the water never calms down"},
      {"eta", "smoothing of the spin, η (1)", &P::eta, none, ""},
      {"epsilon", "confinement, ε (m/s)", &P::epsilon, none, ""},
      {"amplitude", "wavelet turbulence, A (s/m)", &P::amplitude, none, ""},
      {"step", "time step over the default's, by all its limits (1)", &P::step, none, ""},
      {"viscosity", "viscosity, ν dt_max / (viscosity_factor d²) (1)", &P::viscosity, none, ""},
      {"viscosity_factor", "time.viscosity_factor over its default (1)", &P::viscosity_factor, none, ""},
      {"resolution", "particles over those of the scene (1)", &P::resolution, none, ""}};
  return axes;
}

const std::vector<StabilityMap>& stability_maps() {
  static const std::vector<StabilityMap> maps = {
      line("alpha", {0, 0.5, 1, 1.3, 1.6, 2, 3}),
      line("nu_t", {0, 0.05, 0.1, 0.2, 0.4, 0.7, 1}),
      line("eta", {0, 0.0625, 0.125, 0.25, 0.5, 0.75, 1}, {.nu_t = 0.2}, "ν_t = 0.2 m²/s"),
      line("epsilon", {0, 0.05, 0.1, 0.2, 0.5, 1, 2}),
      line("amplitude", {0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2}),
      line("step", {1, 1.5, 2, 2.5, 3, 3.5, 4}),
      line("viscosity", {0, 0.25, 0.5, 1, 2, 4, 8}),
      line("viscosity_factor", {1, 1.5, 2, 3, 4, 6, 8}, {.viscosity = 16}, "ν 16 times what makes its limit bind"),
      line("resolution", {0.5, 1, 2}, {.alpha = 1.3, .nu_t = 0.2}, "α = 1.3, ν_t = 0.2 m²/s"),
      plane("alpha", {0, 0.5, 1, 1.3, 2, 3}, "nu_t", {0, 0.05, 0.1, 0.2, 0.4, 1}),
      plane("alpha", {0, 0.5, 1, 1.3, 2, 3}, "amplitude", {0, 0.005, 0.01, 0.02, 0.05, 0.1}),
      plane("nu_t", {0, 0.05, 0.1, 0.2, 0.4, 1}, "eta", {0, 0.0625, 0.125, 0.25, 0.5, 1}),
      plane("alpha", {0, 0.5, 1, 1.3, 2, 3}, "step", {1, 1.5, 2, 2.5, 3, 4})};
  return maps;
}

StabilityPoint StabilityMap::at(double x_value, double y_value, bool guard) const {
  StabilityPoint point = base;
  point.*x->value = x_value;
  if (y != nullptr) point.*y->value = y_value;
  point.guard = guard;
  return point;
}

StabilityPoint canonical(StabilityPoint point) {
  if (point.nu_t == 0) point.eta = StabilityPoint{}.eta;
  if (point.alpha == 0 && point.nu_t == 0 && point.epsilon == 0 && point.amplitude == 0) point.guard = false;
  return point;
}

Scene at_point(Scene scene, const StabilityPoint& point) {
  if (point.resolution != 1) scene = with_particles(scene, point.resolution * estimate_particles(scene));
  Parameters& p = scene.parameters;
  const double d = scene.spacing();
  p.vorticity_refinement.alpha = point.alpha;
  p.micropolar.nu_t = point.nu_t;
  p.micropolar.eta = point.eta;
  p.vorticity_confinement.epsilon = point.epsilon;
  p.wavelet.amplitude = point.amplitude;
  p.energy.guard = point.guard;
  p.viscosity.nu = point.viscosity * p.time.viscosity_factor * d * d / p.time.max_step;
  p.time.viscosity_factor *= point.viscosity_factor;
  p.time.cfl *= point.step;
  p.time.acceleration_factor *= point.step;
  p.time.max_step *= point.step;
  return scene;
}

const char* verdict_name(Verdict verdict) {
  constexpr const char* names[] = {"calm", "lively", "diverged", "too slow"};
  return names[static_cast<int>(verdict)];
}

std::optional<Verdict> parse_verdict(const std::string& name) {
  for (const Verdict verdict : {Verdict::calm, Verdict::lively, Verdict::diverged, Verdict::too_slow}) {
    if (name == verdict_name(verdict)) return verdict;
  }
  return {};
}

Verdict classify(const StabilityRun& run, double plain_kinetic) {
  if (!run.pass.empty()) return Verdict::diverged;
  if (run.too_slow) return Verdict::too_slow;
  return run.kinetic > lively_over_plain * plain_kinetic ? Verdict::lively : Verdict::calm;
}

std::optional<StabilityRun> run_stability(const Scene& scene, double end, std::uint64_t most_sweeps,
                                          const std::function<bool(double)>& go_on) {
  const auto begin = std::chrono::steady_clock::now();
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  const double start = diagnose(world).total();
  StabilityRun run;
  LastPart kinetic(end);
  double highest = start;
  while (world.time < end && run.pass.empty() && !run.too_slow) {
    try {
      step(world, plan);
    } catch (const DivergedError& error) {
      run.pass = error.pass;
      break;
    }
    if (!go_on(world.time)) return {};
    const Diagnostics d = diagnose(world);
    highest = std::max(highest, d.total());
    kinetic.add(world.time, world.dt, d.kinetic);
    run.most_iterations = std::max(run.most_iterations, world.report.pressure_iterations);
    run.limit_hits += world.report.limit_hits;
    run.too_slow = most_sweeps > 0 && world.work.sweeps > most_sweeps && world.time < end;
  }
  run.end = world.time;
  run.steps = world.step;
  run.sweeps = world.work.sweeps;
  run.gain_percent = start > 0 ? 100 * (highest / start - 1) : 0;
  run.kinetic = run.pass.empty() && !run.too_slow ? kinetic.mean() : NAN;
  run.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

}  // namespace curlew
