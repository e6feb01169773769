// Keeps the turbulence models from adding more energy than the solver has lost. They give back what discretisation
// takes; what they would add beyond it grows without a limit in the worst case (vorticity confinement, the inviscid
// micropolar model, refinement with alpha above 1.2).
//
// The reserve is what the models may add. A step adds energy.share of the solver's loss to it,
//   loss = E before + work of gravity, viscosity, external torque, moving bodies and models - E after,
//   E = sum m (v^2 + Theta w^2) / 2,
// and takes off what the models have added. What is left fades with energy.memory, so that old losses cannot be spent
// in still water; a reserve below zero (a solve may add energy too) does not fade.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// How a model accelerates a particle: so that the guard knows what to take back.
inline void push(Fields& f, std::size_t i, Vec3 acceleration) {
  f.acceleration[i] += acceleration;
  if (!f.model_acceleration.empty()) f.model_acceleration[i] += acceleration;
}

// How a model changes its velocity, once a step.
inline void give(Fields& f, std::size_t i, Vec3 velocity) {
  f.velocity[i] += velocity;
  if (!f.model_velocity.empty()) f.model_velocity[i] = velocity;
}

// Takes back so much of what the models do in this step that the energy they add stays within the reserve: one factor
// for all particles, 0 to 1 (world.report.guard_scale). A particle's velocity changes by a tenth of a spacing a step at
// most. Runs when the models have acted and the other forces are known, before these are applied.
void guard_energy(World& world);

// Brings the reserve up to date, when the particles have moved.
void account_energy(World& world);

}  // namespace curlew
