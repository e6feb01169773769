// Which particles can be seen from a view: for pictures that must be quick, the inside of the water need not be drawn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/camera.h"
#include "sim/core/vec.h"

namespace curlew {

// Indices of the particles in the picture that have fewer than `layers` (1 to 4) others before them in some tile of the
// picture near theirs; tiles are a spacing wide at the farthest particle (wider where that is very far away), and near
// means the 3 x 3 around. w is the factor on the drawn size: what is smaller than 0.9 hides nothing. What is left out
// is covered where particles are drawn as wide as they are apart, but for gaps between all the layers. Keeps the order;
// 2 ms for 40k.
std::vector<std::uint32_t> in_sight(std::span<const Vec3> positions, const View& view, double spacing, int layers = 2);

}  // namespace curlew
