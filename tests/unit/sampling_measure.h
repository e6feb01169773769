// Measures of how even a cloud of samples is.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "sim/scene/scene.h"

namespace curlew::test {

// Nearest neighbours among points up to `reach` away, through cells of that size.
class Cloud {
 public:
  Cloud(const std::vector<Vec3d>& points, double reach) : points_(points), reach_(reach) {
    for (std::size_t i = 0; i < points.size(); ++i)
      cells_[key(cell(points[i].x), cell(points[i].y), cell(points[i].z))].push_back(i);
  }

  // Distance to the nearest point other than number `self`; `reach` where there is none.
  double nearest(Vec3d p, std::size_t self = SIZE_MAX) const {
    double best = reach_;
    const long x0 = cell(p.x), y0 = cell(p.y), z0 = cell(p.z);
    for (long x = x0 - 1; x <= x0 + 1; ++x) {
      for (long y = y0 - 1; y <= y0 + 1; ++y) {
        for (long z = z0 - 1; z <= z0 + 1; ++z) {
          const auto found = cells_.find(key(x, y, z));
          if (found == cells_.end()) continue;
          for (const std::size_t i : found->second) {
            if (i != self) best = std::min(best, length(points_[i] - p));
          }
        }
      }
    }
    return best;
  }

 private:
  long cell(double x) const { return static_cast<long>(std::floor(x / reach_)); }
  static long key(long x, long y, long z) { return (x * 2000003 + y) * 2000003 + z; }

  const std::vector<Vec3d>& points_;
  double reach_;
  std::unordered_map<long, std::vector<std::size_t>> cells_;
};

struct Evenness {
  double closest;  // least distance between two samples, in spacings
  double hole;     // greatest distance of a place of the surface from its nearest sample, in spacings
  double density;  // samples times spacing^(dimension of the surface) over its area
};

// `places` are points all over the surface.
inline Evenness evenness(const std::vector<Vec3d>& samples, const std::vector<Vec3d>& places, double area,
                         double spacing, int surface_dimension) {
  const Cloud cloud(samples, 3 * spacing);
  Evenness result{3, 0, static_cast<double>(samples.size()) * std::pow(spacing, surface_dimension) / area};
  for (std::size_t i = 0; i < samples.size(); ++i)
    result.closest = std::min(result.closest, cloud.nearest(samples[i], i) / spacing);
  for (const Vec3d& p : places) result.hole = std::max(result.hole, cloud.nearest(p) / spacing);
  return result;
}

// Points all over a mesh, about `gap` apart.
inline std::vector<Vec3d> places_on(const TriangleMesh& mesh, double gap) {
  std::vector<Vec3d> places;
  for (const auto& triangle : mesh.triangles) {
    const Vec3d a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]], c = mesh.vertices[triangle[2]];
    const int across = static_cast<int>(std::ceil(length(b - a) / gap)),
              up = static_cast<int>(std::ceil(length(c - a) / gap));
    for (int i = 0; i <= across; ++i) {
      const double s = static_cast<double>(i) / across;
      for (int j = 0; j <= up; ++j) places.push_back(a + s * (b - a) + (1 - s) * j / up * (c - a));
    }
  }
  return places;
}

}  // namespace curlew::test
