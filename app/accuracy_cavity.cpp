// `curlew bench accuracy cavity`: water in a square whose lid moves, in 2D, beside what others have computed on fine
// grids. At Re 100 and 1000 the flow becomes steady, at 10000 it does not (with particles it never quite does), so
// means over a window of time are compared: velocities on the centre lines, and the vortices of the mean stream
// function.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/accuracy.h"
#include "app/cavity_field.h"
#include "app/cavity_reference.h"
#include "app/contour_plot.h"
#include "app/methods.h"
#include "app/numbers.h"
#include "app/progress.h"
#include "app/setup.h"
#include "app/svg_plot.h"
#include "app/work_precision.h"
#include "sim/core/error.h"
#include "sim/measure/diagnostics.h"
#include "sim/scene/reader.h"

namespace curlew {
namespace {

struct CavityCase {
  const CavityReference& reference;
  int across;         // particles
  double begin, end;  // s, of the means
  const BenchOptions& options;

  bool starts_turning() const { return reference.reynolds >= 10000; }
  std::string name() const {
    return "accuracy_cavity_re" + std::to_string(reference.reynolds) + "_" + std::to_string(across);
  }
  std::string title() const {
    return "Lid-driven cavity, Re " + std::to_string(reference.reynolds) + ", " + std::to_string(across) + " x " +
           std::to_string(across) + " particles, mean from " + formatted("%.4g", begin) + " to " +
           formatted("%.4g", end) + " s";
  }
};

struct CavityResult {
  Method method;
  std::string failure;       // the sentence of a run that diverged
  std::vector<double> u, v;  // at the reference's points
  PlotSeries u_line, v_line;
  NodeField psi{1};
  std::vector<CavityVortex> vortices;
  double energy = 0, drift = 0;  // kinetic, J/kg, mean of the window; its second half over the first, less one
  double seconds = 0;            // wall time
  std::int64_t steps = 0;
};

constexpr int line_points = 101;
constexpr double sample_every = 0.05;  // s
constexpr double least_vortex = 1e-6;  // m^2/s
// A corner vortex counts from here on: 30 times less than the weakest at Re 10000.
constexpr double counted_vortex = 5e-5;  // m^2/s

// The flow of an even vorticity whose stream function has its extremum at -0.12 m^2/s, as the primary vortex of all
// references: lap psi = const by a series, and no flow through the walls. At Re 10000 a vortex that starts from rest
// takes hundreds of seconds to gather its speed, since it drags its core along by viscosity alone.
Vec3d turning_core(Vec3d x) {
  constexpr double strength = 0.12 / 0.0736713;  // 1/s; lap psi = -1 has its extremum at 0.0736713
  Vec3d v{0, 0.5 - x.x, 0};
  for (int n = 1; n < 60; n += 2) {
    const double k = n * std::numbers::pi, part = 4 / (k * k) / (1 + std::exp(-k));
    const double near_lid = std::exp(k * (x.y - 1)), near_floor = std::exp(-k * x.y);
    v.x += part * std::sin(k * x.x) * (near_lid - near_floor);
    v.y -= part * std::cos(k * x.x) * (near_lid + near_floor);
  }
  return strength * v;
}

// The guard stays on, with all that is lost to give back, and spins are smoothed as in the paper: without either the
// micropolar model diverges here (without smoothing spins gather 25 times the energy of the flow).
Scene cavity_scene(const CavityCase& c, const Method& method) {
  Scene scene = parse_scene(R"({"curlew": 1, "dimension": 2, "gravity": [0, 0],
    "domain": {"min": [0, 0], "max": [1, 1], "walls": {"x-": "no-slip", "x+": "no-slip", "y-": "no-slip",
      "y+": {"kind": "no-slip", "velocity": [1, 0]}}},
    "fluid": [{"box": {"min": [0, 0], "max": [1, 1]}}],
    "parameters": {"pressure.two_sided": true, "time.max_step": 0.1, "energy.share": 1}})",
                            "bench.json");
  scene.particle_radius = 0.5 / c.across;
  scene.parameters.viscosity.nu = 1.0 / c.reference.reynolds;
  apply_settings(scene.parameters, c.options.settings);
  apply_method(scene.parameters, method);
  return scene;
}

// The reference's points, both centre lines, and the nodes.
std::vector<Vec3d> sample_points(const CavityCase& c) {
  std::vector<Vec3d> points;
  for (const ProfilePoint& p : c.reference.u) points.push_back({0.5, p.at, 0});
  for (const ProfilePoint& p : c.reference.v) points.push_back({p.at, 0.5, 0});
  for (int k = 0; k < line_points; ++k) points.push_back({0.5, k / (line_points - 1.0), 0});
  for (int k = 0; k < line_points; ++k) points.push_back({k / (line_points - 1.0), 0.5, 0});
  for (int j = 0; j <= c.across; ++j) {
    for (int i = 0; i <= c.across; ++i) points.push_back({double(i) / c.across, double(j) / c.across, 0});
  }
  return points;
}

// Reads what was measured, in the order of sample_points.
void read_means(const CavityCase& c, const VelocityMean& mean, CavityResult& r) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < c.reference.u.size(); ++k) r.u.push_back(mean.at(at++).x);
  for (std::size_t k = 0; k < c.reference.v.size(); ++k) r.v.push_back(mean.at(at++).y);
  for (int k = 0; k < line_points; ++k, ++at) {
    r.u_line.x.push_back(mean.at(at).x);
    r.u_line.y.push_back(mean.point(at).y);
  }
  for (int k = 0; k < line_points; ++k, ++at) {
    r.v_line.x.push_back(mean.point(at).x);
    r.v_line.y.push_back(mean.at(at).y);
  }
  NodeField u(static_cast<std::size_t>(c.across)), v(u.across);
  for (std::size_t k = 0; k < u.values.size(); ++k, ++at) {
    u.values[k] = mean.at(at).x;
    v.values[k] = mean.at(at).y;
  }
  r.psi = stream_function(u, v);
  r.vortices = cavity_vortices(r.psi, least_vortex);
}

CavityResult run_cavity(const CavityCase& c, const Method& method) {
  CavityResult r;
  r.method = method;
  const auto begin = std::chrono::steady_clock::now();
  PrecisionRun run(cavity_scene(c, method));
  if (c.starts_turning()) set_velocity(run.world, turning_core);
  VelocityMean mean(sample_points(c));
  std::array<double, 2> energy{}, samples{};  // of both halves of the window
  Progress progress(false);
  double next = c.begin;
  try {
    run.simulate(c.end, [&](const World& world) {
      const double kinetic = kinetic_energy(world) / (double{world.mass} * static_cast<double>(world.count));
      progress.show(std::min(1.0, world.time / c.end),
                    method_label(method) + formatted(", kinetic energy %.5f J/kg", kinetic));
      if (world.time < next) return;
      mean.add(world, sample_every);
      next += sample_every;
      const std::size_t half = world.time < (c.begin + c.end) / 2 ? 0 : 1;
      energy[half] += kinetic;
      ++samples[half];
    });
    progress.finish();
    read_means(c, mean, r);
    r.energy = (energy[0] + energy[1]) / (samples[0] + samples[1]);
    r.drift = energy[1] / samples[1] / (energy[0] / samples[0]) - 1;
  } catch (const DivergedError& error) {
    r.failure = error.what();
  }
  r.steps = run.steps;
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return r;
}

double rms_error(const std::vector<double>& measured, std::span<const ProfilePoint> exact) {
  double sum = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) sum += std::pow(measured[k] - exact[k].velocity, 2);
  return std::sqrt(sum / static_cast<double>(exact.size()));
}

// How many corners hold a vortex that turns against the lid's.
int corner_vortices(const CavityResult& r) {
  int number = 0;
  for (const CavityVortex& vortex : r.vortices) number += vortex.psi >= counted_vortex;
  return number;
}

AccuracyTable error_table(const CavityCase& c, const std::vector<CavityResult>& results) {
  AccuracyTable table{
      {"method", "rms of u", "rms of v", "kinetic energy (J/kg)", "drift (%)", "corner vortices", "steps", "wall s"},
      {}};
  for (const CavityResult& r : results) {
    std::vector<std::string> row{method_label(r.method), "diverged", "", "", "", ""};
    if (r.failure.empty()) {
      row = {method_label(r.method),
             formatted("%.4f", rms_error(r.u, c.reference.u)),
             formatted("%.4f", rms_error(r.v, c.reference.v)),
             formatted("%.5f", r.energy),
             formatted("%.1f", 100 * r.drift),
             std::to_string(corner_vortices(r))};
    }
    row.insert(row.end(), {std::to_string(r.steps), formatted("%.1f", r.seconds)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

AccuracyTable vortex_table(const CavityCase& c, const std::vector<CavityResult>& results) {
  AccuracyTable table{{"method", "vortex", "psi", "x", "y"}, {}};
  const auto add = [&](const std::string& who, const std::string& name, double psi, double x, double y) {
    table.rows.push_back({who, name, formatted("%.4g", psi), formatted("%.4f", x), formatted("%.4f", y)});
  };
  for (const ReferenceVortex& v : c.reference.vortices) add(c.reference.vortex_source, v.name, v.psi, v.x, v.y);
  for (const CavityResult& r : results) {
    for (const CavityVortex& v : r.vortices) add(method_label(r.method), v.name, v.psi, v.x, v.y);
  }
  return table;
}

Plot profile_plot(const CavityCase& c, const std::vector<CavityResult>& results) {
  PlotPanel u{"x = 0.5", {"u / U"}, {"y / L", false, 0, 1}, {}}, v{"y = 0.5", {"x / L", false, 0, 1}, {"v / U"}, {}};
  const LineStyle dots{"#000000", "0 9999", 1, true};  // no line between them
  PlotSeries u_points{c.reference.profile_source, {}, {}, dots}, v_points = u_points;
  for (const ProfilePoint& p : c.reference.u) u_points.x.push_back(p.velocity), u_points.y.push_back(p.at);
  for (const ProfilePoint& p : c.reference.v) v_points.x.push_back(p.at), v_points.y.push_back(p.velocity);
  for (std::size_t k = 0; k < results.size(); ++k) {
    for (const auto& [panel, line] : {std::pair{&u, &results[k].u_line}, std::pair{&v, &results[k].v_line}}) {
      panel->series.push_back({method_label(results[k].method), line->x, line->y, line_style(k + 1)});
    }
  }
  u.series.push_back(std::move(u_points));
  v.series.push_back(std::move(v_points));
  return {c.title(), {std::move(u), std::move(v)}, c.options.command};
}

// Of the primary vortex as in Ghia et al. 1982; in the corners from the noise up.
const std::vector<double>& stream_levels() {
  static const std::vector<double> levels = {-0.12,  -0.1175, -0.115, -0.11,  -0.1,  -0.09,  -0.07, -0.05,
                                             -0.03,  -0.01,   -1e-3,  -1e-4,  -1e-5, 1e-5,   5e-5,  1e-4,
                                             2.5e-4, 5e-4,    1e-3,   1.5e-3, 2e-3,  2.5e-3, 3e-3};
  return levels;
}

ContourPlot stream_plot(const CavityCase& c, const std::vector<CavityResult>& results) {
  ContourPlot plot{c.title(), stream_levels(), {}, {}, c.options.command};
  for (const CavityResult& r : results) {
    if (!r.failure.empty()) continue;
    ContourPanel panel{method_label(r.method), r.psi, {}};
    for (const CavityVortex& v : r.vortices) {
      if (std::abs(v.psi) >= counted_vortex) panel.marks.push_back({v.name, v.x, v.y});
    }
    plot.panels.push_back(std::move(panel));
  }
  std::string note = "Stream function of the mean flow (m^2/s), turning with the lid in blue, against it in red:";
  for (const double level : stream_levels()) note += " " + formatted("%g", level);
  plot.notes = {note};
  return plot;
}

void write_files(const CavityCase& c, const std::vector<CavityResult>& results) {
  if (c.options.out.empty()) return;
  error_table(c, results).write(c.name(), c.options);
  vortex_table(c, results).write(c.name() + "_vortices", c.options);
  const std::string path = c.options.out + "/" + c.name();
  write_svg(path + "_profiles.svg", profile_plot(c, results));
  write_svg(path + "_streamlines.svg", stream_plot(c, results));
}

void run_case(const CavityCase& c) {
  std::printf("\n%s; profiles: %s, vortices: %s\n\n", c.title().c_str(), c.reference.profile_source,
              c.reference.vortex_source);
  std::vector<std::string> methods = c.options.methods;
  if (methods.empty()) methods = {"dfsph", "vc0.1", "mp0.05", "vr1.0"};
  std::vector<CavityResult> results;
  for (const Method& method : parse_methods(methods)) {
    results.push_back(run_cavity(c, method));
    write_files(c, results);  // after each, for runs are long
  }
  error_table(c, results).print();
  std::printf("\n");
  vortex_table(c, results).print();
  for (const CavityResult& r : results) {
    if (!r.failure.empty()) std::printf("%s: %s\n", method_label(r.method).c_str(), r.failure.c_str());
  }
}

const CavityReference& reference_of(const std::string& text) {
  Parameters checked;
  set_parameter(checked, parameter_row("viscosity.nu"), text, "--nu");
  for (const CavityReference& reference : cavity_references()) {
    if (std::abs(checked.viscosity.nu * reference.reynolds - 1) < 1e-9) return reference;
  }
  throw InputError("--nu is \"" + text + "\", expected 0.01, 0.001 or 0.0001, of which the cavity has a reference");
}

// When the means begin and end, s: the flow has been steady for a while, or turns about in the same way (at Re 10000
// after four turns of the core that it starts with).
std::array<double, 2> window_of(int reynolds) {
  if (reynolds <= 100) return {15, 20};
  return reynolds <= 1000 ? std::array<double, 2>{50, 60} : std::array<double, 2>{30, 60};
}

}  // namespace

void check_cavity_nu(const BenchOptions& options) {
  for (const std::string& nu : options.nu) reference_of(nu);
}

void cavity_accuracy(const BenchOptions& options) {
  const std::vector<std::string> nus = options.nu.empty() ? std::vector<std::string>{"0.001", "0.0001"} : options.nu;
  std::vector<CavityCase> cases;
  for (const std::string& nu : nus) {
    const CavityReference& reference = reference_of(nu);
    const auto [begin, end] = window_of(reference.reynolds);
    const double share = options.time_share;
    if (options.cases.empty()) {
      cases.push_back({reference, reference.reynolds == 10000 ? 110 : 100, share * begin, share * end, options});
    }
    for (const std::string& text : options.cases) {
      const auto across = static_cast<int>(parse_particle_number("--cases", text));
      cases.push_back({reference, across, share * begin, share * end, options});
    }
  }
  for (const CavityCase& c : cases) run_case(c);
}

}  // namespace curlew
