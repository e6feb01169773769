// Heightfields: a grid of heights from a CSV file or a formula, with bilinear interpolation between.
#pragma once

#include <string>

#include "sim/scene/scene.h"

namespace curlew {

// Fills heights, columns and rows from the field's file (relative to `folder`) or formula. Throws InputError; `place`
// begins the messages about a formula.
void load_heights(Heightfield&, const std::filesystem::path& folder, int dimension, const std::string& place);

// Height (m) at x, z; outside the box that of its nearest edge.
double height_at(const Heightfield&, double x, double z);

// Signed distance (m), negative inside: exact in height, to first order in the slope.
double distance_to_heightfield(const Heightfield&, Vec3d p, int dimension);

// The filled body as a closed mesh with its sides and floor; heights are cut to the box.
TriangleMesh heightfield_mesh(const Heightfield&);

}  // namespace curlew
