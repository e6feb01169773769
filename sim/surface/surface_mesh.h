// The mesh of the water's surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/core/vec.h"

namespace curlew {

struct SurfaceMesh {
  std::vector<Vec3> position;                           // m
  std::vector<Vec3> normal;                             // unit length, out of the water
  std::vector<Vec3> velocity;                           // m/s, of the water there; empty where nobody asked for it
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside

  bool empty() const { return triangles.empty(); }
};

}  // namespace curlew
