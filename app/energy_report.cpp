#include "app/energy_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace curlew {
namespace {

// Calm is whose kinetic energy in the last second is below this many times DFSPH's, and below this share of what the
// water had to give.
constexpr double calm_over_dfsph = 2, calm_share = 0.01;
constexpr double last_part = 1;  // s

// The plots show no more than this of a run that blows up.
constexpr double most_over_start = 1.15, most_increase = 100, least_increase = -50;

template <class... Values>
std::string text(const char* pattern, Values... values) {
  char line[400];
  std::snprintf(line, sizeof line, pattern, values...);
  return line;
}

std::string cell(const char* pattern, double value) { return std::isfinite(value) ? text(pattern, value) : "-"; }

const EnergyHistory& reference(const std::vector<EnergyCurve>& curves, double nu) {
  const auto plain = [&](const EnergyCurve& curve) { return curve.nu == nu && curve.method.is_plain(); };
  return std::find_if(curves.begin(), curves.end(), plain)->history;
}

// What the water can turn into motion: its energy at the start above the lowest that plain DFSPH comes to.
double available(const EnergyHistory& plain) {
  return plain.mechanical.front() - *std::min_element(plain.potential.begin(), plain.potential.end());
}

double last_kinetic(const EnergyHistory& history) {
  const double end = history.time.back();
  return mean_over(history, history.kinetic, end - last_part, end);
}

bool is_one_of(double value, std::initializer_list<double> values) {
  return std::any_of(values.begin(), values.end(), [&](double other) { return std::abs(value - other) < 1e-9; });
}

// What section 5.1 and the captions of Fig. 7 and 10 say.
std::string paper_words(const EnergyScene& scene, const Method& m) {
  const bool refined = m == Method{.alpha = m.alpha, .sum = m.sum}, micropolar = m == Method{.nu_t = m.nu_t};
  if (m.is_plain()) return "the reference; at rest at the end";
  if (!refined && !micropolar) return "not shown";
  if (scene.name == "dam_break") {
    if (refined && is_one_of(m.alpha, {1, 1.1, 1.2})) return "more while it flows, close to DFSPH after 10 s";
    if (micropolar && is_one_of(m.nu_t, {0.05, 0.1})) return "more while it flows, close to DFSPH after 10 s";
    const bool wild = refined ? is_one_of(m.alpha, {1.3}) : is_one_of(m.nu_t, {0.2, 0.3, 0.4});
    return wild ? "more while it flows, does not converge after 8 s" : "not shown";
  }
  if (micropolar && is_one_of(m.nu_t, {0.2, 0.4})) return "more while it flows, does not converge after 15 s";
  const bool named = refined ? is_one_of(m.alpha, {1, 1.2}) : is_one_of(m.nu_t, {0.05, 0.3});
  return named ? "more while it flows" : "not named";
}

std::string verdict(const EnergyHistory& history, double over_plain, double share) {
  if (!history.complete()) return history.note;
  return over_plain < calm_over_dfsph || share < calm_share ? "yes" : "no";
}

std::string row(const EnergyScene& scene, const EnergyCurve& curve, const EnergyHistory& plain) {
  const EnergyHistory& h = curve.history;
  // A run that ended early has no last second to compare, and no whole window either.
  const bool whole = h.complete() && plain.complete();
  const double increase = whole ? 100 * mean_over(h, h.increase, scene.flow_begin, scene.flow_end) : NAN;
  const double kinetic = h.complete() ? last_kinetic(h) : NAN;
  const double over_plain = whole ? kinetic / last_kinetic(plain) : NAN, share = kinetic / available(plain);
  return text("| %g | ", curve.nu) + method_label(curve.method) + " | " + cell("%+.1f %%", increase) + " | " +
         cell("%.3g J", kinetic) + " | " + cell("%.2f", over_plain) + " | " + cell("%.2g %%", 100 * share) + " | " +
         verdict(h, over_plain, share) + " | " + paper_words(scene, curve.method) + " |\n";
}

// Methods of the paper keep their colour; others take those that are left.
std::vector<LineStyle> styles_of(const std::vector<const EnergyCurve*>& curves) {
  const std::vector<Method>& own = paper_methods();
  std::vector<std::size_t> places;
  for (const EnergyCurve* curve : curves) {
    places.push_back(static_cast<std::size_t>(std::find(own.begin(), own.end(), curve->method) - own.begin()));
  }
  std::vector<LineStyle> styles;
  std::size_t spare = own.size();
  for (std::size_t& place : places) {
    if (place == own.size()) {
      while (spare > 1 && std::find(places.begin(), places.end(), spare - 1) != places.end()) --spare;
      spare = place = std::max<std::size_t>(1, spare - 1);
    }
    styles.push_back(line_style(place));
  }
  return styles;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

// A bound on the axis where some curve goes beyond it; else the data decides.
std::optional<double> bound(const PlotPanel& panel, double limit, bool upper) {
  for (const PlotSeries& series : panel.series) {
    for (const double value : series.y) {
      if (upper ? value > limit : value < limit) return limit;
    }
  }
  return {};
}

}  // namespace

const std::vector<Method>& paper_methods() {
  static const std::vector<Method> methods = parse_methods(
      {"dfsph", "vr1.0", "vr1.1", "vr1.2", "vr1.3", "mp0.05", "mp0.1", "mp0.2", "mp0.3", "mp0.4", "vr1.0+mp0.05"});
  return methods;
}

std::string energy_table(const EnergyScene& scene, const std::vector<EnergyCurve>& curves, const std::string& run,
                         const std::string& command) {
  // A run made shorter than the paper's has a shorter window, or none.
  const double end = curves.front().history.time.back();
  const double window_end =
      end > scene.flow_begin ? std::min(scene.flow_end, std::round(100 * end) / 100) : scene.flow_end;
  std::string out = scene.title + ", " + run + " (`" + command + "`). Mechanical energy is kinetic plus potential, " +
                    "from the floor. Increase: mean of (mechanical energy / that of DFSPH at the same time - 1) " +
                    text("from %g to %g s. ", scene.flow_begin, window_end) +
                    "VR reconstructs by Poisson's equation unless it says sum, which is the paper's way. " +
                    "Kinetic: mean over the last second. Calm: this is below " +
                    text("%g times DFSPH's own or below %g %% of the energy that the water had to give, ",
                         calm_over_dfsph, 100 * calm_share) +
                    "which is its mechanical energy at the start less the lowest potential energy of DFSPH's run";
  for (const EnergyCurve& curve : curves) {
    if (curve.method.is_plain()) out += text(", %.4g kJ at nu = %g", 1e-3 * available(curve.history), curve.nu);
  }
  out +=
      ".\n\n| nu, m^2/s | method | increase | kinetic | of DFSPH's | of what it had | calm | Liu et al. 2020 |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const EnergyCurve& curve : curves) out += row(scene, curve, reference(curves, curve.nu));
  return out;
}

Plot energy_plot(const EnergyScene& scene, const std::vector<EnergyCurve>& curves, double nu, const std::string& run,
                 const std::string& command) {
  std::vector<const EnergyCurve*> shown;
  for (const EnergyCurve& curve : curves) {
    if (curve.nu == nu) shown.push_back(&curve);
  }
  const EnergyHistory& plain = reference(curves, nu);
  const PlotAxis time{"time (s)", false, 0, plain.time.back()};
  PlotPanel energy{"Mechanical energy", time, {"mechanical energy (kJ)"}, {}};
  PlotPanel increase{"Increase over DFSPH", time, {"increase over DFSPH (%)"}, {}};
  const std::vector<LineStyle> styles = styles_of(shown);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const EnergyHistory& h = shown[k]->history;
    const std::string label = method_label(shown[k]->method);
    energy.series.push_back({label, h.time, scaled(h.mechanical, 1e-3), styles[k]});
    increase.series.push_back({label, h.time, scaled(h.increase, 100), styles[k]});
  }
  energy.y.max = bound(energy, most_over_start * 1e-3 * plain.mechanical.front(), true);
  increase.y.max = bound(increase, most_increase, true);
  increase.y.min = bound(increase, least_increase, false);
  return {scene.title + ", " + run + text(", ν = %g m²/s", nu), {energy, increase}, command};
}

}  // namespace curlew
