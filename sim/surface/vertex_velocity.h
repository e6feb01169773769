// The water's velocity at the vertices of its surface.
#pragma once

#include <span>

#include "sim/surface/polygonise.h"

namespace curlew {

// Fills mesh.velocity: at each vertex the mean of the sources' velocities (m/s, one a source), weighted by their
// kernels there. The mesh must be that which `polygoniser` made of `level_set`, smoothed or not.
void find_vertex_velocities(const LevelSet& level_set, const Polygoniser& polygoniser, std::span<const Vec3> velocity,
                            SurfaceMesh& mesh);

}  // namespace curlew
