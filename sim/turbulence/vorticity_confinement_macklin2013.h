// Vorticity confinement: the simplest way to give swirls back what the method takes, and what others are compared with.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// a += epsilon N x omega, N = eta / |eta|, eta = grad |omega|: pushes along the swirl, towards the core of each vortex
// (Steinhoff & Underhill 1994; for particles Macklin & Mueller 2013, section 5). epsilon in m/s. omega is the field
// vorticity at the current positions; eta takes the difference form, sum V_j (|omega_j| - |omega_i|) grad W_ij, which
// vanishes in rigid rotation also at a free surface. Adds energy without a limit.
void vorticity_confinement(World& world);

}  // namespace curlew
