#include "sim/scene/point_grid.h"

#include <algorithm>
#include <cmath>

namespace curlew {

PointGrid::PointGrid(double reach, const Domain& domain) : cell_(reach), domain_(domain), first_(1024, 0) {}

std::array<std::int64_t, 3> PointGrid::cell_of(Vec3d p) const {
  const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
  return {cell(p.x), cell(p.y), cell(p.z)};
}

std::size_t PointGrid::slot_of(std::int64_t x, std::int64_t y, std::int64_t z) const {
  auto hash = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U;
  hash = (hash ^ static_cast<std::uint64_t>(y)) * 0xC2B2AE3D27D4EB4FU;
  hash = (hash ^ static_cast<std::uint64_t>(z)) * 0x165667B19E3779F9U;
  return static_cast<std::size_t>(hash >> 20U) & (first_.size() - 1);
}

void PointGrid::add(Vec3d p) {
  if (points_.size() >= first_.size()) grow();
  const auto [x, y, z] = cell_of(p);
  std::uint32_t& first = first_[slot_of(x, y, z)];
  points_.push_back(p);
  next_.push_back(first);
  first = static_cast<std::uint32_t>(points_.size());
}

void PointGrid::grow() {
  first_.assign(first_.size() * 4, 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto [x, y, z] = cell_of(points_[i]);
    std::uint32_t& first = first_[slot_of(x, y, z)];
    next_[i] = first;
    first = static_cast<std::uint32_t>(i + 1);
  }
}

bool PointGrid::any_near_image(Vec3d p, double square) const {
  const auto [cx, cy, cz] = cell_of(p);
  for (std::int64_t x = cx - 1; x <= cx + 1; ++x) {
    for (std::int64_t y = cy - 1; y <= cy + 1; ++y) {
      for (std::int64_t z = cz - 1; z <= cz + 1; ++z) {
        for (std::uint32_t i = first_[slot_of(x, y, z)]; i != 0; i = next_[i - 1]) {
          const Vec3d offset = points_[i - 1] - p;
          if (dot(offset, offset) < square) return true;
        }
      }
    }
  }
  return false;
}

bool PointGrid::any_within(Vec3d p, double radius) const {
  std::array<Vec3d, 8> images{p};
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain_.periodic[static_cast<std::size_t>(axis)]) continue;
    const double width = domain_.max[axis] - domain_.min[axis];
    const double shift = p[axis] < domain_.min[axis] + radius   ? width
                         : p[axis] > domain_.max[axis] - radius ? -width
                                                                : 0;
    if (shift == 0) continue;
    for (std::size_t i = 0; i < count; ++i) {
      images[count + i] = images[i];
      images[count + i][axis] += shift;
    }
    count *= 2;
  }
  return std::any_of(images.begin(), images.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Vec3d& image) { return any_near_image(image, radius * radius); });
}

std::vector<Vec3d> thinned(const std::vector<Vec3d>& points, double radius, const Domain& domain) {
  PointGrid grid(radius, domain);
  std::vector<Vec3d> kept;
  for (const Vec3d& p : points) {
    if (grid.any_within(p, radius)) continue;
    grid.add(p);
    kept.push_back(p);
  }
  return kept;
}

}  // namespace curlew
