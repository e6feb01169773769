// probes.csv: what the probes of a scene measure, in SI units.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/world.h"
#include "sim/io/csv.h"

namespace curlew {

class ProbeRecorder {
 public:
  // Writes into `folder` where the scene has probes; else it does nothing at all. Of a resumed run the world is the
  // checkpoint's, and the table goes on after its step.
  ProbeRecorder(const std::string& folder, const World& world, bool resumed);

  // A row of the state as it is, where any probe is due: the first state, and of each probe those at or past the next
  // multiple of its `every`. Cells of probes that are not due stay empty.
  void write_due(const World& world);

 private:
  std::unique_ptr<CsvWriter> table_;
  std::vector<double> next_;  // of each probe, the time from which it is due
};

}  // namespace curlew
