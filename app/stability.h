// Where the simulation breaks: the points, lines and planes of `curlew bench stability`, a run at a point, and what
// it is called.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace curlew {

// The default is plain DFSPH.
struct StabilityPoint {
  double alpha = 0, nu_t = 0, eta = 0.125, epsilon = 0, amplitude = 0;
  double step = 1;              // times time.cfl, time.acceleration_factor and time.max_step
  double viscosity = 0;         // times the nu whose step limit is time.max_step
  double viscosity_factor = 1;  // times time.viscosity_factor
  double resolution = 1;        // times the number of particles
  bool guard = false;

  auto operator<=>(const StabilityPoint&) const = default;
};

struct StabilityAxis {
  std::string name, title;  // as --help and the CSV have it; with symbol and unit
  double StabilityPoint::*value;
  double limit;      // a paper's; infinite where there is none
  std::string said;  // by that paper of values from the limit on
};
const std::vector<StabilityAxis>& stability_axes();

// A line where there is no y; values in ascending order.
struct StabilityMap {
  std::string name;
  const StabilityAxis *x, *y;
  std::vector<double> xs, ys;  // a line has one y, which nobody reads
  StabilityPoint base;         // what is the same everywhere
  std::string fixed;           // that in words, or empty

  bool is_line() const { return y == nullptr; }
  StabilityPoint at(double x_value, double y_value, bool guard) const;
};
const std::vector<StabilityMap>& stability_maps();

// Points that are the same run have the same one: nothing to guard where no model is on, no spin to smooth.
StabilityPoint canonical(StabilityPoint point);

// The scene at its resolution with the point's parameters.
Scene at_point(Scene scene, const StabilityPoint& point);

enum class Verdict { calm, lively, diverged, too_slow };
const char* verdict_name(Verdict verdict);
std::optional<Verdict> parse_verdict(const std::string& name);

// Lively has more than this many times the kinetic energy of plain DFSPH in the end; energy above the start counts
// from this share of it on, in per cent.
inline constexpr double lively_over_plain = 2, noted_gain_percent = 0.5;
inline constexpr double last_part = 0.5;       // s, over which that kinetic energy is a mean
inline constexpr double most_work_ratio = 20;  // more sweeps over the neighbours than so many times plain DFSPH's

// What one run found; where it did not come to its end, `kinetic` is not a number.
struct StabilityRun {
  double end = 0;           // s, reached
  std::string pass;         // in which it diverged; else empty
  bool too_slow = false;    // took too many sweeps
  double kinetic = 0;       // J, mean of the last part
  double gain_percent = 0;  // largest rise of kinetic + potential + rotational energy above its start
  std::int64_t steps = 0;
  std::uint64_t sweeps = 0;  // over the neighbours
  int most_iterations = 0;   // of the density solve in a step
  std::int64_t limit_hits = 0;
  double wall = 0;  // s
};

// `plain_kinetic` is that of plain DFSPH at the same resolution.
Verdict classify(const StabilityRun& run, double plain_kinetic);

// Runs until `end` seconds, or until it diverges or has taken more than `most_sweeps` (0: no limit). `go_on` is told
// the time and gives false to stop: then there is no result.
std::optional<StabilityRun> run_stability(const Scene& scene, double end, std::uint64_t most_sweeps,
                                          const std::function<bool(double time)>& go_on);

}  // namespace curlew
