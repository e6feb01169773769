// What depends on positions alone: the sort into cells, the neighbour lists, boundary sums, densities.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// Sorts all kept fields by cell. Stable: particles of a cell keep their order.
void sort_particles(World& world);

void find_neighbours(World& world);

// Walls and bodies: boundary_gradient, their share of neighbour_number and, where allocated, boundary_friction and what
// a curl has to know of no-slip surfaces.
void boundary_sums(World& world);

// density: rho_i = m sum_j W_ij (self included) + boundary. diagonal, neighbour_number.
void compute_density(World& world);

// Kernel-gradient correction (Randles & Libersky 1996; Bonet & Lok 1999): B_i = (- sum V_j grad W_ij (x) x_ij)^-1, with
// which the difference form is exact for linear fields. Left out (B = 1) where neighbours lie too one-sided.
void gradient_correction(World& world);

}  // namespace curlew
