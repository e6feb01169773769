// Fast questions to a closed triangle mesh: is a point inside, and how far is its surface? The triangles are sorted
// into columns along y over a grid in x and z, so that a question looks at a handful of them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/scene/scene.h"

namespace curlew {

class MeshIndex {
 public:
  // Keeps the mesh alive.
  explicit MeshIndex(std::shared_ptr<const TriangleMesh> mesh);

  // Parity of the triangles above the point. Two triangles that share an edge agree on which of them covers a column,
  // so that no column slips between them.
  bool inside(Vec3d p) const;

  // Distance (m) to the surface, or `limit` where it is farther.
  double distance(Vec3d p, double limit) const;

 private:
  int column(double value, int axis) const;  // axis 0: x, 1: z
  void sort_triangles();

  std::shared_ptr<const TriangleMesh> mesh_;
  Vec3d min_, max_;
  double cell_[2] = {1, 1};
  int columns_[2] = {1, 1};
  std::vector<std::uint32_t> begin_;  // of each column in triangles_
  std::vector<std::uint32_t> triangles_;
};

// Distance (m) from p to the triangle a, b, c, degenerate ones included.
double distance_to_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

}  // namespace curlew
