// Incompressible pressure: the divergence-free and constant-density solves of DFSPH (Bender & Koschier 2015, 2017).
//
// Unknown: a stiffness k_i = p_i / rho_i^2 >= 0 for each particle. It accelerates by
//   a_i = - sum_j m (k_i + k_j) grad W_ij - k_i G_i,                   G_i: gradient of the boundary's density,
// and a velocity field changes the density at the rate
//   D_i(v) = sum_j m (v_i - v_j) . grad W_ij + v_i . G_i.
// Both solves ask for k with   r_i = s_i + D_i(a(k)) <= 0,  k_i >= 0,  one of the two zero:
//   density:     s_i = (rho_i - rho_0 + dt D_i(v)) / dt^2     so that the density predicted after the step is rest
//   density divergence:  s_i = D_i(v) / dt                            so that no particle is being compressed
// and then v += dt a(k). The operator -D(a(.)) is symmetric and positive, its diagonal is |S_i|^2 + sum |m grad W_ij|^2
// with S_i = sum m grad W_ij + G_i (the inverse of DFSPH's factor alpha). Boundaries mirror pressure and stay put, so
// all that they do in an iteration is the one vector G_i.
// Since k is a physical pressure over density squared, last step's k is a warm start under any change of dt.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// Velocity to divergence at most pressure.divergence_tolerance; in filled domains with pressure.conserving, by
// projection.h.
void divergence_solve(World& world);

// The mean compression in a step at the velocity as it is, as the divergence solve counts it.
double divergence_error(const World& world);

// Predicted density error to at most pressure.density_tolerance; in short steps to less, over several steps.
void density_solve(World& world);

// Fills the field pressure (Pa) from the sum of both solves, so that its gradient is the force that was felt.
void total_pressure(World& world);

}  // namespace curlew
