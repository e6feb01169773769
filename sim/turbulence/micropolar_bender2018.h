// Micropolar fluid (Bender, Koschier, Kugelstadt & Weiler 2018): particles carry a spin of their own, the microrotation
// omega, and give it back to the flow.
//
//   Dv/Dt += (nu + nu_t) curl omega                                                              (Eq. 6)
//   Theta Domega/Dt = (nu + nu_t) (curl v - 2 omega) + zeta lap omega                            (Eq. 7)
//
// The inviscid model has nu = zeta = 0 in both (Eq. 8, 9): it feeds energy in, a shear wave k grows at the rate
// -nu_t/Theta + sqrt((nu_t/Theta)^2 + nu_t^2 k^2/Theta). In the full model nu is the fluid's own viscosity.
// Walls and bodies do not couple yet: near them spins see the fluid alone.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// What couples spin and flow, m^2/s: nu_t, or nu + nu_t in the full model.
double transfer_coefficient(const Parameters& parameters);

// a += (nu + nu_t) curl omega, in the difference form.
void micropolar_force(World& world);

// omega takes a time step: towards curl v / 2 exactly (exponentially) in time, with diffusion and XSPH (eta, as gamma
// for the velocity) explicit.
void spin(World& world);

// The largest time step (s) that the explicit parts of the model allow; what is off allows all.
double micropolar_step_limit(const World& world);

}  // namespace curlew
