// Error against run time: a case with an exact answer, run over resolutions and settings; as a table, a CSV and a
// work-precision plot with the Pareto front marked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/options.h"
#include "sim/core/passes.h"

namespace curlew {

// A run in hand: the world, and how to take it on to a time.
struct PrecisionRun {
  World world;
  Plan plan;
  std::int64_t steps = 0;

  explicit PrecisionRun(const Scene& scene, FieldSet demanded = {});
  // Steps until `time` (s); after each step `look`, if given, may take what it needs.
  void simulate(double time, const std::function<void(const World&)>& look = {});
};

// Gives every particle of a world that has not begun the velocity (m/s) of a field at its place (m).
void set_velocity(World& world, const std::function<Vec3d(Vec3d)>& field);

// One line of the plot: a variation of the parameters.
struct PrecisionSetting {
  std::string name;
  std::vector<std::string> settings;  // key=value
};

// What every case varies: the kernel's width, tolerances and the time step.
std::vector<PrecisionSetting> usual_settings();
std::vector<PrecisionSetting> with(std::vector<PrecisionSetting> settings, PrecisionSetting more);

// A scene in JSON at a spacing (m).
Scene scene_of(const std::string& json, double spacing);

struct PrecisionCase {
  std::string name, title;
  std::vector<std::string> errors;  // what measure() returns, with units; the first is plotted
  std::vector<int> resolutions;     // particles across the characteristic length
  std::vector<PrecisionSetting> settings;
  Scene (*scene)(int resolution);
  // Runs the scene and returns its errors. Time is taken around it.
  std::vector<double> (*measure)(const Scene& scene, std::int64_t& steps);
};

// What came of a run.
struct PrecisionResult {
  std::string setting;
  int resolution = 0;
  std::vector<double> errors;
  double seconds = 0;
  std::int64_t steps = 0;
  std::string failure;  // the sentence of a run that diverged
};

// Observed order of convergence between consecutive resolutions: log(e1 / e2) / log(n2 / n1).
double observed_order(double coarse_error, int coarse, double fine_error, int fine);

// The results that no other beats in both time and error, fastest first.
std::vector<PrecisionResult> pareto_front(std::vector<PrecisionResult> results);

// Its settings, or those that --settings names; throws InputError where it has none of that name.
std::vector<PrecisionSetting> settings_of(const PrecisionCase& what, const BenchOptions& options);

// Runs all of a case, prints its table, and writes NAME.csv and NAME.svg into the folder that the options name, if they
// do. Options may replace the resolutions (--cases) and add settings to all runs (--set).
void run_precision_case(const PrecisionCase& what, const BenchOptions& options);

// Those with a free surface.
std::vector<PrecisionCase> free_surface_cases();

// All cases of the bench: flows that fill their domain, a tank at rest, and those with a free surface.
const std::vector<PrecisionCase>& precision_cases();

}  // namespace curlew
