// Micropolar fluid (Bender, Koschier, Kugelstadt & Weiler 2018): particles carry a spin of their own, the microrotation
// omega, and give it back to the flow.
//
//   Dv/Dt += (nu + nu_t) curl omega                                                              (Eq. 6)
//   Theta Domega/Dt = (nu + nu_t) (curl v - 2 omega) + zeta lap omega + tau                      (Eq. 7)
//
// The inviscid model has nu = zeta = 0 in both (Eq. 8, 9): it feeds energy in, a shear wave k grows at the rate
// -nu_t/Theta + sqrt((nu_t/Theta)^2 + nu_t^2 k^2/Theta). In the full model nu is the fluid's own viscosity.
//
// Walls reflect spins: a slip wall exerts no torque, at a no-slip wall fluid neither moves nor spins; no-slip bodies
// are samples that do neither. Of the curl pairs, `conjugate` conserves linear momentum to round-off:
//   difference:  curl A_i = sum V_j (A_i - A_j) x grad W_ij                                      (the paper's)
//   symmetric:   curl A_i = -rho_i sum m (A_i / rho_i^2 + A_j / rho_j^2) x grad W_ij
//   conjugate:   curl omega by its adjoint, -sum m (omega_i / rho_i + omega_j / rho_j) x grad W_ij, curl v by
//   difference
#pragma once

#include "sim/core/world.h"

namespace curlew {

// What couples spin and flow, m^2/s: nu_t, or nu + nu_t in the full model.
double transfer_coefficient(const Parameters& parameters);

// a += (nu + nu_t) curl omega, and omega takes a time step: towards its equilibrium exactly (exponentially) in time,
// with diffusion and XSPH (eta, as gamma for the velocity) explicit. One sweep; the time step has to be known.
void couple_spin_and_flow(World& world);

// The largest time step (s) that the explicit parts of the model allow; what is off allows all.
double micropolar_step_limit(const World& world);

}  // namespace curlew
