// The benchmarks of `curlew bench`, and what they share.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/options.h"
#include "sim/core/passes.h"

namespace curlew {

// One row a benchmark: the command line, its help and the dispatch read this table.
struct BenchRow {
  std::string name, about;
  std::vector<std::string> options;  // that it heeds; another is an error
  int (*run)(const BenchOptions&);
};
std::span<const BenchRow> bench_table();
const BenchRow& bench_row(const std::string& name);

int bench_speed(const BenchOptions& options);
int bench_memory(const BenchOptions& options);
int bench_energy(const BenchOptions& options);
int bench_overhead(const BenchOptions& options);
int bench_turbulence(const BenchOptions& options);
int bench_stability(const BenchOptions& options);
int bench_surface(const BenchOptions& options);
int bench_render(const BenchOptions& options);

// A bundled scene with --set and about this number of particles.
Scene bench_scene(const std::string& name, double nu, const std::string& particles, const BenchOptions& options);

// The one number of --cases, for a benchmark that takes one.
std::string single_case(const BenchOptions& options, const std::string& otherwise);

// As many iterations for all, whatever the flow: no solve ends before its limit.
void fix_iterations(PressureParameters& pressure);

double median(std::vector<double> values);

struct PassTimes : PassObserver {
  std::map<std::string, double> ms;
  void after(const Pass& pass, const World&, double milliseconds) override {
    ms[std::string(pass.name)] += milliseconds;
  }
};

}  // namespace curlew
