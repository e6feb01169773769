// One run of `curlew bench energy`: a scene with a method, and its energies over time as a CSV file that is there under
// its name only when it is complete.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace curlew {

// Joules at the first states at or past every sixtieth of a second, and the last. `increase` is that of the mechanical
// energy over the run without a method, as a fraction, not a number where there is none to compare with.
struct EnergyHistory {
  std::vector<double> time, kinetic, rotational, potential, mechanical, total, increase;
  std::string note;  // why the run ended early; else empty

  std::size_t size() const { return time.size(); }
  bool complete() const { return note.empty(); }
};

// The mean of a column over the rows from `begin` to `end` seconds; not a number where there is none.
double mean_over(const EnergyHistory& history, const std::vector<double>& column, double begin, double end);

// Runs until `end` seconds and writes the file. `reference` is the run to compare with, null for the reference itself;
// `show` is told the time and gives false to stop. Returns false where it was stopped: then there is no file. A run
// that diverges is complete and says so in its last row.
bool simulate_energies(const Scene& scene, double end, const EnergyHistory* reference, const std::string& file,
                       const std::function<bool(double time)>& show);

// Throws InputError naming the file where it is not what simulate_energies writes.
EnergyHistory read_energies(const std::string& file);

}  // namespace curlew
