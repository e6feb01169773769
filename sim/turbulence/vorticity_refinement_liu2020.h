// Vorticity refinement (Liu, Wang, Ban, Xu, Zhou, Kosinka & Telea 2020, Alg. 2): what vorticity a step should have left
// and what it did leave differ by what the pressure solves and the advection have lost; that is given back.
//
//   zeta = curl v                                                                                (Eq. 6)
//   zeta' = zeta + dt ((zeta . grad) v - zeta div v)                                             (Eq. 7, 11)
//   dzeta = zeta' - curl v~          v~: after both solves, at the new positions                 (Eq. 12)
//   lap psi = -dzeta,  v = v~ + alpha curl psi                                                   (Eq. 13 to 17)
//
// The term with div v is zero in the paper's incompressible fluid; but where pressure does not pull, water flies apart,
// and without it a free drop gains 13 % of its angular momentum in a turn of 1 rad (0.1 % with it).
// zeta is taken after the forces and XSPH, which change vorticity because they are meant to: the paper's nu lap zeta is
// the curl of the viscous force, and walls, the micropolar model and confinement come in the same way. Both curls use
// the neighbours of their own positions. Walls count as in the velocity gradient; beside bodies, as at a free surface,
// particles are not surrounded well enough to be believed.
//
// reconstruction = sum:     psi_i = sum dzeta_j V_j / (4 pi r_ij) over neighbours within 0.995 of the support; in 2D
//                           -sum dzeta_j V_j ln(r_ij / R) / (2 pi). The cut makes it a band-pass: of a loss with the
//                           wave length 6d 0.8 comes back, of one with 32d 0.06 (see the tests).
// reconstruction = poisson: see vector_potential.h.
//
// Curls are taken with the kernel-gradient correction and with the fluid's reflections in walls, so that they are exact
// for linear velocities; particles at a free surface, where that is not enough, lose nothing as far as refinement
// knows, and so do those that have no prediction yet (the first step, or just emitted). Spray, as the divergence solve
// counts it, gets nothing.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// v += alpha curl psi; fills lost_vorticity and stream_function.
void refine_vorticity(World& world);

// predicted_vorticity for the end of the step that is about to be taken.
void predict_vorticity(World& world);

}  // namespace curlew
