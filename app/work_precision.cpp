#include "app/work_precision.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/accuracy.h"
#include "app/numbers.h"
#include "app/setup.h"
#include "app/svg_plot.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/core/watch.h"
#include "sim/io/csv.h"
#include "sim/scene/reader.h"
#include "sim/sph/motion.h"

namespace curlew {
namespace {

std::string number(double value) { return formatted("%.4g", value); }

PrecisionResult run_one(const PrecisionCase& what, const PrecisionSetting& setting, int resolution,
                        const BenchOptions& options) {
  Scene scene = what.scene(resolution);
  scene.parameters.energy.guard = false;  // what the methods do by themselves
  apply_settings(scene.parameters, setting.settings);
  apply_settings(scene.parameters, options.settings);
  PrecisionResult result{setting.name, resolution, {}, 0, 0, {}};
  const auto begin = std::chrono::steady_clock::now();
  try {
    result.errors = what.measure(scene, result.steps);
  } catch (const DivergedError& error) {
    result.failure = error.what();
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

// The order that a run shows over the one before it with the same setting.
std::string order_text(const std::vector<PrecisionResult>& results, std::size_t k) {
  const PrecisionResult& fine = results[k];
  for (std::size_t j = k; j-- > 0;) {
    const PrecisionResult& coarse = results[j];
    if (coarse.setting != fine.setting || coarse.errors.empty() || fine.errors.empty()) continue;
    return formatted("%.2f", observed_order(coarse.errors[0], coarse.resolution, fine.errors[0], fine.resolution));
  }
  return "";
}

AccuracyTable table_of(const PrecisionCase& what, const std::vector<PrecisionResult>& results) {
  AccuracyTable table{{"setting", "resolution"}, {}};
  table.columns.insert(table.columns.end(), what.errors.begin(), what.errors.end());
  for (const char* column : {"order", "steps", "wall s"}) table.columns.emplace_back(column);
  for (std::size_t k = 0; k < results.size(); ++k) {
    const PrecisionResult& r = results[k];
    std::vector<std::string> row{r.setting, std::to_string(r.resolution)};
    for (std::size_t e = 0; e < what.errors.size(); ++e) row.push_back(r.errors.empty() ? "" : number(r.errors[e]));
    row.insert(row.end(), {order_text(results, k), std::to_string(r.steps), formatted("%.2f", r.seconds)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Plot plot_of(const PrecisionCase& what, const std::vector<PrecisionResult>& results, const std::string& command) {
  PlotPanel panel{"", {"wall time (s)", true, {}, {}}, {what.errors[0], true, {}, {}}, {}};
  PlotSeries front{"Pareto front", {}, {}, {"#bbbbbb", "", 7, false}};
  for (const PrecisionResult& r : pareto_front(results)) {
    front.x.push_back(r.seconds);
    front.y.push_back(r.errors[0]);
  }
  panel.series.push_back(std::move(front));
  for (std::size_t k = 0; k < what.settings.size(); ++k) {
    PlotSeries series{what.settings[k].name, {}, {}, line_style(k)};
    series.style.markers = true;
    for (const PrecisionResult& r : results) {
      if (r.setting != series.name || r.errors.empty()) continue;
      series.x.push_back(r.seconds);
      series.y.push_back(r.errors[0]);
    }
    panel.series.push_back(std::move(series));
  }
  return {what.title, {std::move(panel)}, command};
}

std::vector<int> resolutions_of(const PrecisionCase& what, const BenchOptions& options) {
  if (options.cases.empty()) return what.resolutions;
  std::vector<int> resolutions;
  for (const std::string& text : options.cases) {
    resolutions.push_back(static_cast<int>(parse_particle_number("--cases", text)));
  }
  std::sort(resolutions.begin(), resolutions.end());
  return resolutions;
}

}  // namespace

Scene scene_of(const std::string& json, double spacing) {
  Scene scene = parse_scene(json, "bench.json");
  scene.particle_radius = spacing / 2;
  return scene;
}

void set_velocity(World& world, const std::function<Vec3d(Vec3d)>& field) {
  parallel_for(world.count,
               [&](std::size_t i) { world.fields.velocity[i] = to_float(field(to_double(world.fields.position[i]))); });
  world.dt = initial_time_step(world);
  forgive(world);
}

std::vector<PrecisionSetting> usual_settings() {
  return {
      {"default", {}},
      {"h/d 1.1", {"sph.h_over_d=1.1"}},
      {"h/d 1.3", {"sph.h_over_d=1.3"}},
      {"h/d 1.6", {"sph.h_over_d=1.6"}},
      {"Wendland 1.1", {"sph.kernel=wendland", "sph.h_over_d=1.1"}},
      {"Wendland 1.3", {"sph.kernel=wendland", "sph.h_over_d=1.3"}},
      {"tolerances / 10",
       {"pressure.density_tolerance=1e-5", "pressure.divergence_tolerance=1e-4", "pressure.relative_tolerance=0.03"}},
      {"tolerances x 10",
       {"pressure.density_tolerance=1e-3", "pressure.divergence_tolerance=1e-2", "pressure.relative_tolerance=1"}},
      {"steps / 2",
       {"time.cfl=0.15", "time.acceleration_factor=0.125", "time.viscosity_factor=0.0625", "time.max_step=0.0025"}},
      {"cold start", {"pressure.warm_start=false"}},
  };
}

std::vector<PrecisionSetting> with(std::vector<PrecisionSetting> settings, PrecisionSetting more) {
  settings.push_back(std::move(more));
  return settings;
}

PrecisionRun::PrecisionRun(const Scene& scene, FieldSet demanded)
    : world(make_world(scene)), plan(make_plan(world, demanded)) {
  prepare(world, plan);
}

void PrecisionRun::simulate(double time, const std::function<void(const World&)>& look) {
  while (world.time < time - 1e-12) {
    step(world, plan);
    ++steps;
    if (look) look(world);
  }
}

double observed_order(double coarse_error, int coarse, double fine_error, int fine) {
  return std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine) / coarse);
}

std::vector<PrecisionResult> pareto_front(std::vector<PrecisionResult> results) {
  std::erase_if(results, [](const PrecisionResult& r) { return r.errors.empty() || !std::isfinite(r.errors[0]); });
  std::stable_sort(results.begin(), results.end(), [](const PrecisionResult& a, const PrecisionResult& b) {
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.errors[0] < b.errors[0];
  });
  std::vector<PrecisionResult> front;
  for (PrecisionResult& r : results) {
    if (front.empty() || r.errors[0] < front.back().errors[0]) front.push_back(std::move(r));
  }
  return front;
}

std::vector<PrecisionSetting> settings_of(const PrecisionCase& what, const BenchOptions& options) {
  if (options.rows.empty()) return what.settings;
  std::vector<PrecisionSetting> chosen;
  for (const std::string& name : options.rows) {
    const auto found = std::find_if(what.settings.begin(), what.settings.end(),
                                    [&](const PrecisionSetting& s) { return s.name == name; });
    if (found == what.settings.end()) {
      std::string known;
      for (const PrecisionSetting& s : what.settings) known += (known.empty() ? "\"" : ", \"") + s.name + "\"";
      throw InputError("--settings is \"" + name + "\", of the accuracy case " + what.name + " expected one of " +
                       known);
    }
    chosen.push_back(*found);
  }
  return chosen;
}

void run_precision_case(const PrecisionCase& what, const BenchOptions& options) {
  std::printf("\n%s\n\n", what.title.c_str());
  std::vector<PrecisionResult> results;
  for (const PrecisionSetting& setting : settings_of(what, options)) {
    for (const int resolution : resolutions_of(what, options)) {
      results.push_back(run_one(what, setting, resolution, options));
    }
  }
  const AccuracyTable table = table_of(what, results);
  table.print();
  for (const PrecisionResult& r : results) {
    if (!r.failure.empty()) std::printf("%s, %d: %s\n", r.setting.c_str(), r.resolution, r.failure.c_str());
  }
  std::fflush(stdout);
  if (options.out.empty()) return;
  table.write("accuracy_" + what.name, options);
  write_svg(options.out + "/accuracy_" + what.name + ".svg", plot_of(what, results, options.command));
}

}  // namespace curlew
