// A step is an ordered list of passes that reads like the paper's algorithm. Each pass says which fields it reads and
// writes and when it is wanted; the plan keeps only those that somebody needs and allocates only what they touch.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sim/core/world.h"

namespace curlew {

struct Pass {
  std::string_view name;
  FieldSet reads, writes;
  bool (*wanted)(const World&);  // a switch of the scene or the parameters
  void (*run)(World&);
  bool changes_velocity = false;  // guarded: finite, and no faster than time.max_displacement allows
  bool essential = false;         // does something beside writing fields
};

// All passes, in the order of the step (DFSPH as in Liu et al. 2020, Alg. 1, turned so that a step ends with the
// neighbours, densities and boundaries of its new positions).
std::span<const Pass> pass_table();

struct Plan {
  std::vector<const Pass*> step;     // in order
  std::vector<const Pass*> prepare;  // the part that depends on positions alone, run once before the first step
  FieldSet fields;                   // allocated
};

// The passes needed to carry the kept fields on and to fill the fields in `demanded` (by renderer, stats, exports).
Plan make_plan(const World& world, FieldSet demanded = {});

// Gives the plan's fields their memory and releases that of all others.
void allocate(World& world, const Plan& plan);

// Brings a new or loaded world to the state between two steps.
void prepare(World& world, const Plan& plan);

// Called after each pass with the milliseconds it took.
struct PassObserver {
  virtual ~PassObserver() = default;
  virtual void after(const Pass& pass, const World& world, double milliseconds) = 0;
};

// Advances the world by one step. Throws DivergedError naming the pass and the particle where a velocity is not finite
// or too fast; the world is then put back to the state before the step.
void step(World& world, const Plan& plan, PassObserver* observer = nullptr);

}  // namespace curlew
