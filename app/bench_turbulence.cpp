// `curlew bench turbulence`: the energy spectrum of turbulence that decays in a periodic cube, with each method, and
// that of the wavelet noise which one of them adds.
//
// The start is a random field with Kolmogorov's spectrum, E ~ k^(-5/3), from the waves as long as the cube to those of
// four spacings; a flow without a limit to its waves would keep that slope while energy moves on to shorter ones. Slope
// and level are taken from shell 2 (the first has 18 waves) to waves of six spacings, and a spectrum departs where E
// k^(5/3) first is more than twice its mean there, or less than half of it. Each method runs without the energy guard,
// and in a cube of 1 m at 1 m/s, as strengths of wavelet turbulence (s/m) and of the micropolar model (m^2/s) have
// units.
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/accuracy.h"
#include "app/bench.h"
#include "app/methods.h"
#include "app/numbers.h"
#include "app/progress.h"
#include "app/setup.h"
#include "app/svg_plot.h"
#include "app/work_precision.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/core/watch.h"
#include "sim/measure/diagnostics.h"
#include "sim/measure/random_field.h"
#include "sim/measure/spectrum.h"
#include "sim/scene/reader.h"
#include "sim/turbulence/wavelet_turbulence_fujisawa2011.h"

namespace curlew {
namespace {

constexpr double side = 1;            // m
constexpr double start_energy = 1.5;  // J/kg: a speed of 1 m/s along each axis
constexpr int least_across = 16, most_across = 256;
constexpr double turnovers = 2;
constexpr std::array<double, 3> looks = {0.25, 0.5, 1};  // at the spectrum, in shares of the time
constexpr double band = 2;                               // of E k^(5/3) around its mean
constexpr std::uint64_t seed = 1;
constexpr std::array<std::size_t, 6> colours = {0, 1, 5, 7, 3, 8};  // of line_style, one a method

// Three octaves of the noise, in a cube as wide as its smallest tile: waves of two cells, where an octave has most of
// its energy, are in shell 16 for the coarsest and in shell 64 for the finest. Octaves whose energies fall by 2^(-5/3),
// as in the papers, have E ~ k^(-8/3), as each is spread over twice the wave numbers of the one before.
constexpr int octaves = 3, coarse_cells = WaveletNoise::smallest, noise_grid = 192;
constexpr std::size_t noise_first = 16, noise_last = 64;

// A spectrum, and of what.
struct Entry {
  std::string who, file;
  double time = NAN, energy = NAN;  // s; J/kg of the particles themselves
  double share = 0;                 // of the time, for which it was asked
  Spectrum spectrum;                // empty where the run diverged before
  std::size_t first = 0, last = 0;  // shells of the fit
};

struct Case {
  int across;
  Spectrum start;
  double turnover, end;  // s

  std::size_t first() const { return 2; }
  std::size_t last() const { return static_cast<std::size_t>(std::max(4, across / 6)); }
  std::size_t shortest() const { return static_cast<std::size_t>(across / 4); }
  std::size_t nyquist() const { return static_cast<std::size_t>(across / 2); }
  double spacing() const { return side / across; }
};

Case case_of(const BenchOptions& options) {
  const double number = parse_particle_number("--cases", single_case(options, "40"));
  if (!(number >= least_across && number <= most_across)) {
    throw InputError("--cases is " + formatted("%g", number) + ", expected from 16 to 256 particles across the cube");
  }
  const int across = static_cast<int>(number);
  Case c{across, kolmogorov_spectrum(side, across / 4, start_energy), 0, 0};
  c.turnover = turnover_time(c.start);
  c.end = options.time.value_or(turnovers * c.turnover) * options.time_share;
  return c;
}

Scene scene_of(const Case& c, const Method& method, const BenchOptions& options) {
  Scene scene = parse_scene(R"({"curlew": 1, "gravity": [0, 0, 0],
    "domain": {"min": [0, 0, 0], "max": [1, 1, 1], "periodic": [true, true, true]},
    "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "jitter": 0.25}],
    "parameters": {"pressure.two_sided": true, "pressure.divergence_tolerance": 1e-4,
      "micropolar.eta": 0, "energy.guard": false}})",
                            "bench.json");
  scene.domain.max = {side, side, side};
  scene.fluid[0].shape = Box{scene.domain.min, scene.domain.max};
  scene.particle_radius = c.spacing() / 2;
  apply_settings(scene.parameters, options.settings);
  apply_method(scene.parameters, method);
  return scene;
}

Entry entry_of(const Case& c, const std::string& who, const std::string& name, const World& world, double share) {
  const double energy = kinetic_energy(world) / (double{world.mass} * static_cast<double>(world.count));
  const VelocityGrid grid =
      velocities_on_grid({world.fields.position.data(), world.count}, {world.fields.velocity.data(), world.count},
                         c.spacing(), 2 * c.across, side);
  return {
      who,     name + formatted("_%.3fs", share * c.end), world.time, energy, share, energy_spectrum(grid), c.first(),
      c.last()};
}

struct Cost {
  std::string who, failure;
  double seconds = 0;
  std::int64_t steps = 0;
};

// Adds the spectrum of the start, if it is the first run, and those of the looks.
Cost run_method(const Case& c, const Method& method, const BenchOptions& options, std::vector<Entry>& entries) {
  const std::string label = method_label(method), name = method_name(method);
  Cost cost{label, "", 0, 0};
  Progress progress(false);
  PrecisionRun run(scene_of(c, method, options));
  const RandomField field(c.start, seed);
  set_velocity(run.world, [&](Vec3d x) { return field.at(x); });
  if (entries.empty()) entries.push_back(entry_of(c, "start", "start", run.world, 0));
  for (const double share : looks) {
    const auto begin = std::chrono::steady_clock::now();
    try {
      run.simulate(share * c.end, [&](const World& w) { progress.show(std::min(1.0, w.time / c.end), label); });
      entries.push_back(entry_of(c, label, name, run.world, share));
    } catch (const DivergedError& error) {
      cost.failure = error.what();
      break;
    }
    cost.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  progress.finish();
  cost.steps = run.steps;
  return cost;
}

// What wavelet turbulence multiplies with the energy of the flow: y, which has no unit, over its octaves.
Entry noise_entry() {
  const WaveletNoise noise(coarse_cells, seed);
  const TurbulenceField field(noise, side / std::ldexp(coarse_cells, octaves - 1), octaves, 0, 3);
  VelocityGrid grid = make_velocity_grid(noise_grid, side);
  parallel_for(grid.velocity.size(), [&](std::size_t node) {
    const auto place = [&](std::size_t k) { return static_cast<int>(k % noise_grid); };
    const Vec3d x = grid.place(place(node), place(node / noise_grid), place(node / noise_grid / noise_grid));
    grid.velocity[node] = to_double(field.at(to_float(x)));
  });
  Entry entry{"wavelet noise y", "noise", NAN, 0, 0, energy_spectrum(grid), noise_first, noise_last};
  entry.energy = entry.spectrum.total();
  return entry;
}

std::string or_dash(const char* pattern, double value) {
  return std::isfinite(value) ? formatted(pattern, value) : "-";
}

// Down to waves of two spacings, which is as far as particles carry any.
std::string departure_text(const Case& c, const Entry& e, bool is_flow) {
  const std::size_t n = departure(e.spectrum, e.first, e.last, band);
  if (n >= e.spectrum.energy.size() || (is_flow && n > c.nyquist())) return is_flow ? "not down to 2 d" : "nowhere";
  const std::string k = formatted("%.0f", e.spectrum.wave_number(n));
  return is_flow ? k + formatted(" (%.1f d)", c.across / static_cast<double>(n)) : k;
}

std::vector<std::string> row_of(const Case& c, const Entry& e) {
  const PowerLaw law = fit_power_law(e.spectrum, e.first, e.last);
  double resolved = 0;
  for (std::size_t n = 0; n <= c.shortest(); ++n) resolved += e.spectrum.energy[n] * e.spectrum.step;
  const bool is_flow = std::isfinite(e.time);
  return {e.who,
          or_dash("%.3f", e.time),
          or_dash("%.2f", e.time / c.turnover),
          formatted("%.4f", e.energy),
          is_flow ? formatted("%.4f", e.energy - resolved) : "-",
          formatted("%.2f", law.slope),
          formatted("%.3g", compensated_level(e.spectrum, e.first, e.last)),
          departure_text(c, e, is_flow)};
}

AccuracyTable table_of(const Case& c, const std::vector<Entry>& entries) {
  AccuracyTable table{{"method", "t (s)", "turnovers", "energy (J/kg)", "of it below 4 d", "slope",
                       "mean E k^(5/3) (m^(4/3)/s^2)", "departs at k (1/m)"},
                      {}};
  for (const Entry& e : entries) table.rows.push_back(row_of(c, e));
  return table;
}

// All shells that the grid's own waves fill.
std::size_t shells_of(const Spectrum& spectrum) {
  return static_cast<std::size_t>(static_cast<double>(spectrum.energy.size() - 1) / std::sqrt(3.0));
}

void write_spectrum(const Entry& e, const BenchOptions& options) {
  AccuracyTable table{{"k (1/m)", "E (m^3/s^2)", "E k^(5/3) (m^(4/3)/s^2)"}, {}};
  for (std::size_t n = 1; n <= shells_of(e.spectrum); ++n) {
    const double k = e.spectrum.wave_number(n), energy = e.spectrum.energy[n];
    table.rows.push_back(
        {formatted("%.6g", k), formatted("%.6g", energy), formatted("%.6g", energy * std::pow(k, 5.0 / 3))});
  }
  table.write("turbulence_" + e.file, options);
}

PlotSeries line_of(const Entry& e, std::size_t last, LineStyle style) {
  PlotSeries line{e.who, {}, {}, style};
  for (std::size_t n = 1; n <= std::min(last, shells_of(e.spectrum)); ++n) {
    line.x.push_back(e.spectrum.wave_number(n));
    line.y.push_back(e.spectrum.energy[n]);
  }
  return line;
}

// E = level k^(-thirds / 3).
PlotSeries power_line(int thirds, double level, double from, double to) {
  const auto at = [&](double k) { return level * std::pow(k, -thirds / 3.0); };
  const std::string dash = thirds == 5 ? "3 4" : "10 4";
  return {"k^(-" + std::to_string(thirds) + "/3)", {from, to}, {at(from), at(to)}, {"#999999", dash, 2}};
}

// One for the panels of all times, a little beyond what they show.
PlotAxis energy_axis(const Case& c, const std::vector<Entry>& entries) {
  PlotAxis axis{"E (m³/s²)", true, 1e300, 0};
  for (const Entry& e : entries) {
    if (!std::isfinite(e.time)) continue;
    for (std::size_t n = 1; n <= (e.share > 0 ? c.nyquist() : c.shortest()); ++n) {
      axis.min = std::min(*axis.min, e.spectrum.energy[n] / 1.3);
      axis.max = std::max(*axis.max, e.spectrum.energy[n] * 1.3);
    }
  }
  return axis;
}

PlotPanel flow_panel(const Case& c, const std::vector<Entry>& entries, const std::vector<Method>& methods,
                     double share) {
  const Entry& start = entries.front();
  const double time = share * c.end, least = c.start.step, most = start.spectrum.wave_number(c.nyquist());
  PlotPanel panel{formatted("t = %.2f s, ", time) + formatted("%.2g turnover times", time / c.turnover),
                  {"k (1/m)", true, least, most},
                  energy_axis(c, entries),
                  {}};
  panel.series.push_back(power_line(5, compensated_level(start.spectrum, c.first(), c.last()), least, most));
  panel.series.push_back(line_of(start, c.shortest(), {"#cccccc", "", 6}));
  for (std::size_t m = 0; m < methods.size(); ++m) {
    for (const Entry& e : entries) {
      if (e.who != method_label(methods[m]) || e.share != share) continue;
      panel.series.push_back(line_of(e, c.nyquist(), line_style(colours[m % colours.size()])));
    }
  }
  return panel;
}

PlotPanel noise_panel(const Entry& noise) {
  const double step = noise.spectrum.step, most = noise_grid / 2;
  PlotPanel panel{"Wavelet noise y", {"k (1/m)", true, 6 * step, most * step}, {"E of y (m)", true, {}, {}}, {}};
  const double level = compensated_level(noise.spectrum, noise.first, noise.last);
  const double from = noise.spectrum.wave_number(noise.first), to = noise.spectrum.wave_number(noise.last);
  panel.series.push_back(power_line(5, level, from, to));
  panel.series.push_back(power_line(8, level * std::sqrt(from * to), from, to));
  PlotSeries line = line_of(noise, shells_of(noise.spectrum), line_style(9));
  line.x.erase(line.x.begin(), line.x.begin() + 5);  // below its coarsest octave there is nothing to see
  line.y.erase(line.y.begin(), line.y.begin() + 5);
  panel.series.push_back(std::move(line));
  return panel;
}

Plot plot_of(const Case& c, const std::vector<Entry>& entries, const std::vector<Method>& methods,
             const std::string& command) {
  Plot plot{"Decaying turbulence in a cube of 1 m, " + std::to_string(c.across) + "³ particles, inviscid", {}, command};
  for (const double share : looks) plot.panels.push_back(flow_panel(c, entries, methods, share));
  plot.panels.push_back(noise_panel(entries.back()));
  return plot;
}

// How much of the start's energy the way from particles to the grid keeps, at waves about as many spacings long.
void print_arrival(const Case& c, const Entry& start) {
  std::string text;
  std::size_t last = 0;
  for (const int length : {8, 6, 4}) {
    const auto n = static_cast<std::size_t>(c.across / length);
    if (std::exchange(last, n) == n) continue;
    text += (text.empty() ? "" : ", ") + formatted("%.3f", start.spectrum.energy[n] / c.start.energy[n]) +
            formatted(" of waves of %.1f d", c.across / static_cast<double>(n));
  }
  std::printf("On the grid the start has of its energy %s\n", text.c_str());
}

}  // namespace

int bench_turbulence(const BenchOptions& options) {
  check_free(options.settings, {});
  std::vector<std::string> names = options.methods;
  if (names.empty()) names = {"dfsph", "vr1.0", "mp0.05", "wt0.02"};
  const std::vector<Method> methods = parse_methods(names);
  const Case c = case_of(options);
  std::printf("Decaying turbulence, cube of 1 m, %d^3 particles, turnover time %.2f s, %d threads, %s\n", c.across,
              c.turnover, omp_get_max_threads(), CURLEW_ISA_NAME);
  std::vector<Entry> entries;
  std::vector<Cost> costs;
  for (const Method& method : methods) costs.push_back(run_method(c, method, options, entries));
  print_arrival(c, entries.front());
  entries.push_back(noise_entry());
  std::printf("\n");
  const AccuracyTable table = table_of(c, entries);
  table.print();
  std::printf("\n");
  for (const Cost& cost : costs) {
    std::printf("%s: %s%lld steps, %.1f s\n", cost.who.c_str(),
                cost.failure.empty() ? "" : (cost.failure + "; ").c_str(), static_cast<long long>(cost.steps),
                cost.seconds);
  }
  if (options.out.empty()) return 0;
  table.write("turbulence", options);
  for (const Entry& e : entries) write_spectrum(e, options);
  write_svg(options.out + "/turbulence.svg", plot_of(c, entries, methods, options.command));
  return 0;
}

}  // namespace curlew
