// What `curlew bench stability` keeps and shows: its table of cells, which is also what it resumes from, the summary
// and the maps.
#pragma once

#include <compare>
#include <map>
#include <string>
#include <vector>

#include "app/heat_map.h"
#include "app/stability.h"

namespace curlew {

struct StabilityScene {
  std::string name, label;  // "dam_break_2d", "2D"
  Scene scene;
  std::map<double, std::size_t> particles;  // by StabilityPoint::resolution

  std::size_t particles_at(const StabilityPoint& point) const { return particles.at(point.resolution); }
};

// One run; the point is canonical.
struct StabilityKey {
  std::string scene;
  std::size_t particles;
  StabilityPoint point;
  auto operator<=>(const StabilityKey&) const = default;
};
using StabilityRuns = std::map<StabilityKey, StabilityRun>;
StabilityKey stability_key(const StabilityScene& scene, const StabilityPoint& point);
StabilityPoint plain_point(double resolution);

// What is to be shown, in order.
struct StabilityPlan {
  std::vector<StabilityScene> scenes;
  std::vector<StabilityMap> maps;
};

// The cells in a file, none where there is no file. Throws InputError naming the line that is not one of ours.
StabilityRuns read_stability(const std::string& file);

// All cells of the plan that have run, after the rows that the file has beside them.
void write_stability(const std::string& file, const StabilityPlan& plan, const StabilityRuns& runs);

// These two need all cells.
std::string stability_summary(const StabilityPlan& plan, const StabilityRuns& runs, const std::string& about);
// "lines.svg" and one a plane, by the name of the file.
std::map<std::string, HeatMap> stability_pictures(const StabilityPlan& plan, const StabilityRuns& runs,
                                                  const std::string& about, const std::string& command);

}  // namespace curlew
