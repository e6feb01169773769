// Sums over all particles, in double precision and in a fixed order.
#pragma once

#include <cstdint>

#include "sim/core/world.h"

namespace curlew {

struct Diagnostics {
  double kinetic = 0;      // J; per metre of depth in 2D, like everything here
  double rotational = 0;   // J, of microrotation
  double potential = 0;    // J, from the domain's lowest point
  Vec3d momentum;          // kg m/s
  Vec3d angular_momentum;  // kg m^2/s, about the origin
  double max_speed = 0;    // m/s

  double mechanical() const { return kinetic + potential; }
  double total() const { return mechanical() + rotational; }
};

Diagnostics diagnose(const World& world);

double kinetic_energy(const World& world);
// Of microrotation, Theta omega^2 / 2 a mass; 0 where the model is off.
double rotational_energy(const World& world);

// From the field vorticity: 1/2 sum V |omega|^2 (m^3/s^2) and sum V v . omega (m^4/s^2).
double enstrophy(const World& world);
double helicity(const World& world);

// How many particles are where no fluid may be: beyond a wall, or inside a body.
std::int64_t count_outside(const World& world);

}  // namespace curlew
