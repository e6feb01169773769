// Even samples on triangle meshes and on the outlines of 2D heightfields. Lengths in metres.
#pragma once

#include <vector>

#include "sim/scene/scene.h"

namespace curlew {

// Poisson-disc samples: sharp edges first, then the faces, so that no two are nearer than 0.6 spacings and no hole is
// wider than a spacing needs. Triangles outside the domain, or in one of its walls, are left out.
std::vector<Vec3d> sample_mesh(const TriangleMesh&, double spacing, const Domain&);

// The outline of a heightfield in 2D; what lies in a wall of the domain is left out.
std::vector<Vec3d> sample_outline(const Heightfield&, double spacing, const Domain&);

}  // namespace curlew
