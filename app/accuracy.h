// `curlew bench accuracy`: cases with an exact answer, each run with every method.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"
#include "sim/scene/scene.h"

namespace curlew {

// A method as the parameters that switch it on.
struct AccuracyMethod {
  std::string name;
  std::vector<std::string> settings;  // key=value
};

// Plain DFSPH first; then vorticity confinement (VC), the micropolar model (MP) and vorticity refinement (VR).
const std::vector<AccuracyMethod>& accuracy_methods();

// A bundled scene at each resolution that the options ask for (its own if none), with their settings and a method's.
std::vector<Scene> accuracy_scenes(const std::string& name, const BenchOptions& options);
Scene with_method(Scene scene, const AccuracyMethod& method);

// A table of text: as Markdown on standard output, and as CSV in the folder that the options name, if they do.
struct AccuracyTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  void print() const;
  void write(const std::string& name, const BenchOptions& options) const;
};

// printf for one number.
std::string formatted(const char* format, double value);

// The cases; each prints its tables.
void gresho_chan_accuracy(const BenchOptions& options);
void lamb_oseen_accuracy(const BenchOptions& options);
void taylor_vortex_accuracy(const BenchOptions& options);
void spinning_drop_accuracy(const BenchOptions& options);
// Long; with every turbulence method, or with those of --methods.
void cavity_accuracy(const BenchOptions& options);
void check_cavity_nu(const BenchOptions& options);  // throws InputError where there is no reference
void taylor_green_3d_accuracy(const BenchOptions& options);

int accuracy_bench(const BenchOptions& options);

}  // namespace curlew
