// Domains filled with fluid, with pressure.conserving: a true projection, and a step of second order around it.
#pragma once

#include "sim/core/world.h"

namespace curlew {

struct PressureSolution {
  int iterations = 0;
  double error = 0;  // mean compression in a step that is left
};

// Solves D(a(k)) = -source for k of either sign, D the corrected density rate and a(k) its adjoint, from the field
// source (kg/m^3/s^2) into divergence_stiffness, and leaves a(k) in the field acceleration. Particles that have no
// part, or whose density shows that they lie at a hole, have k = 0.
// Conjugate gradients, since nothing binds k to one sign: on the lid-driven cavity, 40 x 40 particles, 17 iterations a
// step where momentum took 43, and 37 where it took 76.
// Ends at pressure.relative_tolerance of what the source would compress in a step, at most
// pressure.divergence_tolerance. The share is what counts: a flow of scale L at N particles across brings forth some
// (dt U / L)^2 of compression in a step, 1e-4 at N = 40 and 1e-5 at 100, and a fixed tolerance lets all of that pass.
PressureSolution project(World& world);

// With pressure.conserving, where a is the acceleration by the divergence solve at the step's beginning. A solve after
// each move is a projection of first order, which takes dt^2 a^2 / 2 from the energy. If its push acts once more after
// the next move, the velocity is reflected instead and keeps its energy (Zehnder, Narain & Thomaszewski 2018, "An
// advection-reflection solver for detail-preserving fluid simulation"); for particles this is the trapezoidal rule for
// the pressure's force, (1 + theta) a in all. theta = pressure.reflection below 1 damps pressures that change sign from
// step to step. Particles move with the velocity of the middle of the step, v + dt (1 + theta) a / 2: moved with v
// alone they spiral out of every vortex, the density solve pulls them back, and refinement takes that for a loss.
void midpoint_velocity(World& world);
// From there to v + theta dt a, when the particles have moved.
void reflect_velocity(World& world);

}  // namespace curlew
