#include "app/probes.h"

#include <algorithm>
#include <cmath>

#include "sim/core/params.h"
#include "sim/measure/probes.h"

namespace curlew {
namespace {

// The multiple of `every` after `time`; each state is due where it is 0.
double next_time(const Probe& probe, double time) {
  return probe.every > 0 ? probe.every * (std::floor(time / probe.every + 1e-9) + 1) : 0;
}

bool is_due(const Probe& probe, double next, double time) { return time >= next - 1e-9 * probe.every; }

}  // namespace

ProbeRecorder::ProbeRecorder(const std::string& folder, const World& world, bool resumed) {
  const Scene& scene = world.scene;
  if (scene.probes.empty()) return;
  std::vector<std::string> columns{"step", "time"};
  for (const Probe& probe : scene.probes) {
    for (std::string& column : probe_columns(probe, scene.dimension)) columns.push_back(std::move(column));
    next_.push_back(resumed ? next_time(probe, world.time) : 0);
  }
  table_ =
      std::make_unique<CsvWriter>(folder + "/probes.csv", columns, resumed ? std::optional(world.step) : std::nullopt);
}

void ProbeRecorder::write_due(const World& world) {
  if (!table_) return;
  const std::vector<Probe>& probes = world.scene.probes;
  bool any = false;
  std::vector<std::string> cells{std::to_string(world.step), number_text(world.time)};
  for (std::size_t k = 0; k < probes.size(); ++k) {
    if (!is_due(probes[k], next_[k], world.time)) {
      cells.resize(cells.size() + probe_columns(probes[k], world.scene.dimension).size());
      continue;
    }
    any = true;
    next_[k] = next_time(probes[k], world.time);
    for (const auto& value : measure(world, probes[k])) cells.push_back(value ? number_text(*value) : "");
  }
  if (any) table_->row(cells);
}

}  // namespace curlew
