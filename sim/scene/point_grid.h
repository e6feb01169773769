// Points in a hash table of cells, for "is any point nearer than this?" while points are being added.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/scene/scene.h"

namespace curlew {

class PointGrid {
 public:
  // Questions may ask for radii up to `reach`. Periodic axes of the domain wrap.
  PointGrid(double reach, const Domain& domain);

  void add(Vec3d p);
  bool any_within(Vec3d p, double radius) const;  // strictly nearer than radius
  std::size_t size() const { return points_.size(); }

 private:
  std::array<std::int64_t, 3> cell_of(Vec3d p) const;
  std::size_t slot_of(std::int64_t x, std::int64_t y, std::int64_t z) const;
  bool any_near_image(Vec3d p, double square) const;
  void grow();

  double cell_;
  Domain domain_;
  std::vector<Vec3d> points_;
  std::vector<std::uint32_t> next_;   // in the same slot; 0 ends, else index + 1
  std::vector<std::uint32_t> first_;  // of each slot
};

// The points of which none is nearer than `radius` to one that was kept before it.
std::vector<Vec3d> thinned(const std::vector<Vec3d>& points, double radius, const Domain&);

}  // namespace curlew
