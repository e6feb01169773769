// What depends on positions alone: the sort into cells, the neighbour lists, boundary sums, densities.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// Sorts all kept fields by cell. Stable: particles of a cell keep their order.
void sort_particles(World& world);

void find_neighbours(World& world);

// Walls and bodies: boundary_gradient, boundary_friction (where allocated) and their share of neighbour_number.
void boundary_sums(World& world);

// density: rho_i = m sum_j W_ij (self included) + boundary. diagonal, neighbour_number.
void compute_density(World& world);

}  // namespace curlew
