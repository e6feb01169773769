// `curlew bench accuracy taylor_green_3d`: a vortex that breaks up into turbulence, in a periodic box of (2 pi)^3 at
// Re 1600, beside a direct numerical simulation. 64^3 particles resolve none of its small eddies, so what is measured
// is what the solver and each turbulence method do in their place: energy, and its rate of loss.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/accuracy.h"
#include "app/methods.h"
#include "app/numbers.h"
#include "app/progress.h"
#include "app/setup.h"
#include "app/svg_plot.h"
#include "app/taylor_green_3d.h"
#include "app/work_precision.h"
#include "sim/core/error.h"
#include "sim/measure/diagnostics.h"
#include "sim/scene/reader.h"

namespace curlew {
namespace {

constexpr double end_time = 10;  // L / U; the dissipation is largest at 8.98
constexpr double slope_width = 0.5;

// Time, energy <v^2> / 2 and its rate of loss of a simulation with 512^3 points: Dairay, Lamballais, Laizet &
// Vassilicos 2017, J. Comput. Phys. 337:252-274.
struct DnsPoint {
  double time, energy, loss;
};
constexpr DnsPoint dns[] = {
    {0, 0.125, 0.00046875},       {0.2, 0.124906, 0.00047035},  {0.4, 0.124812, 0.00047592},
    {0.6, 0.124716, 0.00048564},  {0.8, 0.124617, 0.0004998},   {1, 0.124515, 0.00051882},
    {1.2, 0.124409, 0.00054321},  {1.4, 0.124298, 0.00057356},  {1.6, 0.124179, 0.00061055},
    {1.8, 0.124053, 0.00065495},  {2, 0.123917, 0.00070756},    {2.2, 0.123769, 0.00076927},
    {2.4, 0.123608, 0.00084098},  {2.6, 0.123432, 0.00092366},  {2.8, 0.123238, 0.0010184},
    {3, 0.123024, 0.0011265},     {3.2, 0.122786, 0.0012505},   {3.4, 0.122522, 0.0013947},
    {3.6, 0.122227, 0.0015681},   {3.8, 0.121892, 0.0017856},   {4, 0.121508, 0.0020662},
    {4.2, 0.121061, 0.0024206},   {4.4, 0.120536, 0.0028389},   {4.6, 0.119923, 0.0032855},
    {4.8, 0.119222, 0.0037253},   {5, 0.118436, 0.0041271},     {5.2, 0.117575, 0.0044682},
    {5.4, 0.116653, 0.0047486},   {5.6, 0.115678, 0.0049895},   {5.8, 0.114656, 0.0052346},
    {6, 0.113581, 0.0055309},     {6.2, 0.112439, 0.0059082},   {6.4, 0.111212, 0.0063677},
    {6.6, 0.109887, 0.0068813},   {6.8, 0.108476, 0.0071721},   {7, 0.107025, 0.0073648},
    {7.2, 0.105514, 0.0077776},   {7.4, 0.103899, 0.0083982},   {7.6, 0.102154, 0.0090348},
    {7.8, 0.100289, 0.0096344},   {8, 0.0982896, 0.010373},     {8.2, 0.0961434, 0.011062},
    {8.4, 0.0938766, 0.011597},   {8.6, 0.0914896, 0.012317},   {8.8, 0.0889692, 0.012777},
    {9, 0.0864029, 0.012853},     {9.2, 0.0838545, 0.01254},    {9.4, 0.0814119, 0.011899},
    {9.6, 0.0790639, 0.011632},   {9.8, 0.076754, 0.011462},    {10, 0.0744799, 0.011273},
    {10.2, 0.0722353, 0.011183},  {10.4, 0.0700113, 0.011031},  {10.6, 0.0678336, 0.010731},
    {10.8, 0.0657183, 0.010424},  {11, 0.0636659, 0.010095},    {11.2, 0.0616823, 0.0097394},
    {11.4, 0.0597702, 0.0093821}, {11.6, 0.0579283, 0.0090408}, {11.8, 0.0561524, 0.0087181},
    {12, 0.0544432, 0.0083628},
};

struct TaylorGreenResult {
  Method method;
  std::string failure;
  EnergyCurve curve;
  double seconds = 0;
  std::int64_t steps = 0;
};

DnsPoint dns_at(double time) {
  for (const DnsPoint& p : dns) {
    if (p.time >= time - 1e-9) return p;
  }
  return dns[std::size(dns) - 1];
}

TaylorGreenResult run_method(int across, const Method& method, const BenchOptions& options) {
  TaylorGreenResult r;
  r.method = method;
  Scene scene = taylor_green_3d_scene(across);
  apply_settings(scene.parameters, options.settings);
  apply_method(scene.parameters, method);
  const double end = end_time * options.time_share;
  Progress progress(false);
  const auto begin = std::chrono::steady_clock::now();
  PrecisionRun run(scene);
  r.curve.add(run.world);
  try {
    run.simulate(end, [&](const World& world) {
      r.curve.add(world);
      progress.show(std::min(1.0, world.time / end),
                    method_label(method) + formatted(", kinetic energy %.5f J/kg", r.curve.energy.back()));
    });
  } catch (const DivergedError& error) {
    r.failure = error.what();
  }
  progress.finish();
  r.steps = run.steps;
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return r;
}

std::vector<std::string> row_of(const TaylorGreenResult& r, double end) {
  const EnergyCurve::Loss peak = r.curve.largest_loss(slope_width);
  return {method_label(r.method),
          r.failure.empty() ? formatted("%.5f", r.curve.at(end / 2)) : "diverged",
          formatted("%.5f", peak.rate),
          formatted("%.2f", peak.time),
          r.failure.empty() ? formatted("%.5f", r.curve.at(end)) : "",
          std::to_string(r.steps),
          formatted("%.1f", r.seconds)};
}

AccuracyTable table_of(const std::vector<TaylorGreenResult>& results, double end) {
  AccuracyTable table{{"method", formatted("energy at t = %g", end / 2), "largest loss a second", "at time",
                       formatted("energy at t = %g", end), "steps", "wall s"},
                      {}};
  DnsPoint peak = dns[0];
  for (const DnsPoint& p : dns) {
    if (p.time <= end && p.loss > peak.loss) peak = p;
  }
  table.rows.push_back({"DNS", formatted("%.5f", dns_at(end / 2).energy), formatted("%.5f", peak.loss),
                        formatted("%.2f", peak.time), formatted("%.5f", dns_at(end).energy), "", ""});
  for (const TaylorGreenResult& r : results) table.rows.push_back(row_of(r, end));
  return table;
}

AccuracyTable curves_of(const std::vector<TaylorGreenResult>& results) {
  AccuracyTable table{{"method", "time", "energy", "loss"}, {}};
  const auto add = [&](const std::string& who, double time, double energy, double loss) {
    table.rows.push_back(
        {who, formatted("%.6g", time), formatted("%.7g", energy), std::isfinite(loss) ? formatted("%.5g", loss) : ""});
  };
  for (const DnsPoint& p : dns) add("DNS", p.time, p.energy, p.loss);
  for (const TaylorGreenResult& r : results) {
    for (std::size_t k = 0; k < r.curve.time.size(); ++k) {
      const double time = r.curve.time[k];
      add(method_label(r.method), time, r.curve.energy[k], r.curve.loss(time, slope_width));
    }
  }
  return table;
}

Plot plot_of(const std::vector<TaylorGreenResult>& results, int across, double end, const std::string& command) {
  PlotPanel energy{"Kinetic energy", {"t (s)", false, 0, end}, {"E (J/kg)", false, 0, {}}, {}};
  PlotPanel loss{"Its loss", {"t (s)", false, 0, end}, {"-dE/dt (W/kg)", false, 0, {}}, {}};
  PlotSeries exact{"DNS", {}, {}, line_style(0)}, exact_loss = exact;
  for (const DnsPoint& p : dns) {
    exact.x.push_back(p.time), exact.y.push_back(p.energy);
    exact_loss.x.push_back(p.time), exact_loss.y.push_back(p.loss);
  }
  energy.series.push_back(std::move(exact));
  loss.series.push_back(std::move(exact_loss));
  for (std::size_t k = 0; k < results.size(); ++k) {
    const EnergyCurve& curve = results[k].curve;
    PlotSeries line{method_label(results[k].method), curve.time, curve.energy, line_style(k + 1)}, rate = line;
    for (std::size_t n = 0; n < rate.y.size(); ++n) rate.y[n] = curve.loss(curve.time[n], slope_width);
    energy.series.push_back(std::move(line));
    loss.series.push_back(std::move(rate));
  }
  return {"Taylor-Green vortex in 3D, Re 1600, " + std::to_string(across) + "^3 particles",
          {std::move(energy), std::move(loss)},
          command};
}

void run_case(int across, const BenchOptions& options) {
  const std::string cube = std::to_string(across) + "^3", name = "accuracy_taylor_green_3d_" + std::to_string(across);
  const double end = end_time * options.time_share;
  std::printf("\nTaylor-Green vortex in 3D, Re 1600, %s particles; J/kg, W/kg and s\n\n", cube.c_str());
  std::vector<std::string> methods = options.methods;
  if (methods.empty()) methods = {"dfsph", "vc0.1", "mp0.05", "vr1.0"};
  std::vector<TaylorGreenResult> results;
  for (const Method& method : parse_methods(methods)) {
    results.push_back(run_method(across, method, options));
    if (options.out.empty()) continue;
    table_of(results, end).write(name, options);  // after each, for runs are long
    curves_of(results).write(name + "_curves", options);
    write_svg(options.out + "/" + name + ".svg", plot_of(results, across, end, options.command));
  }
  table_of(results, end).print();
  for (const TaylorGreenResult& r : results) {
    if (!r.failure.empty()) std::printf("%s: %s\n", method_label(r.method).c_str(), r.failure.c_str());
  }
}

}  // namespace

void EnergyCurve::add(const World& world) {
  time.push_back(world.time);
  energy.push_back(kinetic_energy(world) / (double{world.mass} * static_cast<double>(world.count)));
}

double EnergyCurve::at(double t) const {
  for (std::size_t k = 1; k < time.size(); ++k) {
    if (time[k] < t) continue;
    return std::lerp(energy[k - 1], energy[k], (t - time[k - 1]) / (time[k] - time[k - 1]));
  }
  return NAN;
}

double EnergyCurve::loss(double t, double width) const {
  if (time.empty() || t < time.front() + width / 2 - 1e-9 || t > time.back() - width / 2 + 1e-9) return NAN;
  double n = 0, st = 0, se = 0, stt = 0, ste = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double s = time[k] - t;
    if (std::abs(s) > width / 2) continue;
    n += 1, st += s, se += energy[k], stt += s * s, ste += s * energy[k];
  }
  return n < 3 ? NAN : -(n * ste - st * se) / (n * stt - st * st);
}

EnergyCurve::Loss EnergyCurve::largest_loss(double width) const {
  Loss largest{NAN, NAN};
  for (const double t : time) {
    const double rate = loss(t, width);
    if (std::isfinite(rate) && !(rate <= largest.rate)) largest = {t, rate};
  }
  return largest;
}

Scene taylor_green_3d_scene(int across) {
  const double length = 2 * std::numbers::pi;
  Scene scene = parse_scene(R"({"curlew": 1, "gravity": [0, 0, 0],
    "domain": {"min": [0, 0, 0], "max": [1, 1, 1], "periodic": [true, true, true]},
    "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "velocity": {"field": "taylor_green"}, "jitter": 0.25}],
    "parameters": {"viscosity.nu": 0.000625, "pressure.two_sided": true, "pressure.divergence_tolerance": 1e-4,
      "time.max_step": 1, "micropolar.eta": 0, "energy.guard": false}})",
                            "bench.json");
  scene.domain.max = {length, length, length};
  scene.fluid[0].shape = Box{scene.domain.min, scene.domain.max};
  scene.particle_radius = length / across / 2;
  return scene;
}

void taylor_green_3d_accuracy(const BenchOptions& options) {
  std::vector<int> resolutions;
  for (const std::string& text : options.cases) {
    resolutions.push_back(static_cast<int>(parse_particle_number("--cases", text)));
  }
  if (resolutions.empty()) resolutions = {64};
  for (const int across : resolutions) run_case(across, options);
}

}  // namespace curlew
