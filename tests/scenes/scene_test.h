// A scene test reads like prose: make a scene, let time pass, ask what the run was like.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/core/passes.h"
#include "sim/measure/diagnostics.h"

namespace curlew {

// The scene of that name in assets/scenes.
Scene bundled(const std::string& name);

// The scene with so many particles to a metre.
Scene at_particles_per_metre(Scene scene, int number);

// A closed box from the origin to `size` (m) with slip walls, gravity downwards and nothing in it; 2D where size.z is
// 0.
Scene empty_box(Vec3d size, int particles_per_metre);

// Fluid that begins with the same velocity (m/s) everywhere, or with v_x = speed sin(k y), one wave over the height.
Fluid moving(Shape shape, Vec3d velocity);
Fluid with_shear_wave(Shape shape, double speed);

// The world with its particles moved at random, by up to so many spacings along each axis.
World jittered(World world, double spacings);

// What the world was like after a step.
struct Moment {
  double time = 0, dt = 0;  // s
  Diagnostics sums;
  StepReport report;
  std::int64_t outside = 0;  // particles where no fluid may be
};

// A world that steps and remembers.
class Run {
 public:
  explicit Run(const Scene& scene, FieldSet demanded = {});
  // The world, after some change to its particles.
  explicit Run(World changed, FieldSet demanded = {});

  World world;

  void simulate(double seconds);
  void take_steps(int number);

  // The steps so far; the first moment is before the first step.
  const std::vector<Moment>& history() const { return history_; }
  const Moment& now() const { return history_.back(); }

  std::size_t step_number() const { return history_.size() - 1; }
  // The share of the steps for which holds(moment).
  template <class Holds>
  double share_of_steps(Holds&& holds) const;
  // The mean and the largest of value(moment) over the steps from a time on.
  template <class Value>
  double mean(Value&& value, double from_time = 0) const;
  template <class Value>
  double largest(Value&& value, double from_time = 0) const;

  // The most by which mechanical energy ever grew within `window` seconds, as a fraction of its value before.
  double energy_rise(double window = 0.5) const;

 private:
  void remember();

  Plan plan_;
  std::vector<Moment> history_;
};

// sqrt(mean |v|^2), m/s.
double rms_speed(const World& world);

// sum m |v|, kg m/s: what momentum is to be measured against.
double absolute_momentum(const World& world);

// For each particle by rising id; nothing of a field that is not in use.
std::vector<Vec3d> by_id(const World& world, const Array<Vec3>& field);
std::vector<Vec3d> positions_by_id(const World& world);
std::vector<Vec3d> velocities_by_id(const World& world);

// The amplitude (m/s) and the wave number (1/m) of such a shear wave.
double shear_wave_amplitude(const World& world);
double shear_wave_number(const Scene& scene);

template <class Holds>
double Run::share_of_steps(Holds&& holds) const {
  return mean([&](const Moment& moment) { return holds(moment) ? 1.0 : 0.0; });
}

template <class Value>
double Run::mean(Value&& value, double from_time) const {
  double sum = 0, number = 0;
  for (std::size_t k = 1; k < history_.size(); ++k) {
    if (history_[k].time <= from_time) continue;
    sum += static_cast<double>(value(history_[k]));
    ++number;
  }
  return sum / number;
}

template <class Value>
double Run::largest(Value&& value, double from_time) const {
  double most = -1e300;
  for (std::size_t k = 1; k < history_.size(); ++k) {
    if (history_[k].time > from_time) most = std::max(most, static_cast<double>(value(history_[k])));
  }
  return most;
}

}  // namespace curlew
