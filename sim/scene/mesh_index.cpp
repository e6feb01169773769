#include "sim/scene/mesh_index.h"

#include <algorithm>
#include <cmath>

namespace curlew {
namespace {

double clamp01(double t) { return t >= 1 ? 1 : t > 0 ? t : 0; }  // NaN becomes 0

double distance_to_segment(Vec3d p, Vec3d a, Vec3d b) {
  const Vec3d along = b - a;
  return length(p - (a + clamp01(dot(p - a, along) / dot(along, along)) * along));
}

// Does the edge between a and b, seen along y, cross the ray from (x, z) towards +x? The ends are put in order first,
// so that both triangles of an edge compute the very same number.
bool crosses(Vec3d a, Vec3d b, double x, double z) {
  if ((a.z > z) == (b.z > z)) return false;
  if (a.z > b.z || (a.z == b.z && a.x > b.x)) std::swap(a, b);
  return x < a.x + (z - a.z) * (b.x - a.x) / (b.z - a.z);
}

// Height at which the triangle's plane meets the column (x, z).
double height_at(Vec3d a, Vec3d b, Vec3d c, double x, double z) {
  const Vec3d normal = cross(b - a, c - a);
  return a.y - (normal.x * (x - a.x) + normal.z * (z - a.z)) / normal.y;
}

}  // namespace

double distance_to_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d normal = cross(b - a, c - a);
  const double square = dot(normal, normal);
  const auto left_of = [&](Vec3d u, Vec3d v) { return dot(cross(v - u, p - u), normal) >= 0; };
  if (square > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a))
    return std::abs(dot(p - a, normal)) / std::sqrt(square);
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

MeshIndex::MeshIndex(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {
  if (mesh_->vertices.empty()) return;
  min_ = max_ = mesh_->vertices[0];
  for (const Vec3d& v : mesh_->vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      min_[axis] = std::min(min_[axis], v[axis]);
      max_[axis] = std::max(max_[axis], v[axis]);
    }
  }
  const double width = max_.x - min_.x, depth = max_.z - min_.z;
  const double side = std::sqrt(width * depth / static_cast<double>(mesh_->triangles.size() + 1));
  constexpr double most = 2048;
  columns_[0] = static_cast<int>(side > 0 ? std::clamp(std::ceil(width / side), 1.0, most) : 1);
  columns_[1] = static_cast<int>(side > 0 ? std::clamp(std::ceil(depth / side), 1.0, most) : 1);
  cell_[0] = width > 0 ? width / columns_[0] : 1;
  cell_[1] = depth > 0 ? depth / columns_[1] : 1;
  sort_triangles();
}

int MeshIndex::column(double value, int axis) const {
  const double from = axis == 0 ? min_.x : min_.z;
  return static_cast<int>(std::clamp(std::floor((value - from) / cell_[axis]), 0.0, columns_[axis] - 1.0));
}

// Counting sort, in two rounds: count, then place.
void MeshIndex::sort_triangles() {
  begin_.assign(static_cast<std::size_t>(columns_[0]) * static_cast<std::size_t>(columns_[1]) + 2, 0);
  for (const bool place : {false, true}) {
    for (std::uint32_t t = 0; t < mesh_->triangles.size(); ++t) {
      const auto& [ia, ib, ic] = mesh_->triangles[t];
      const Vec3d a = mesh_->vertices[ia], b = mesh_->vertices[ib], c = mesh_->vertices[ic];
      const int x1 = column(std::max({a.x, b.x, c.x}), 0), z1 = column(std::max({a.z, b.z, c.z}), 1);
      for (int z = column(std::min({a.z, b.z, c.z}), 1); z <= z1; ++z) {
        for (int x = column(std::min({a.x, b.x, c.x}), 0); x <= x1; ++x) {
          const std::size_t at =
              static_cast<std::size_t>(z) * static_cast<std::size_t>(columns_[0]) + static_cast<std::size_t>(x);
          if (place) {
            triangles_[begin_[at + 1]++] = t;
          } else {
            ++begin_[at + 2];
          }
        }
      }
    }
    if (place) break;
    for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    triangles_.resize(begin_.back());
  }
}

bool MeshIndex::inside(Vec3d p) const {
  if (mesh_->vertices.empty()) return false;
  // A nudge off the round numbers at which both lattices and hand-made meshes like to lie.
  const double x = p.x + 1.2345e-10 * (max_.x - min_.x), z = p.z + 2.7182e-10 * (max_.z - min_.z);
  if (!(x >= min_.x && x <= max_.x && p.y >= min_.y && p.y <= max_.y && z >= min_.z && z <= max_.z)) return false;
  const std::size_t at = static_cast<std::size_t>(column(z, 1)) * static_cast<std::size_t>(columns_[0]) +
                         static_cast<std::size_t>(column(x, 0));
  bool odd = false;
  for (std::uint32_t i = begin_[at]; i < begin_[at + 1]; ++i) {
    const auto& [ia, ib, ic] = mesh_->triangles[triangles_[i]];
    const Vec3d a = mesh_->vertices[ia], b = mesh_->vertices[ib], c = mesh_->vertices[ic];
    const bool covers = crosses(a, b, x, z) != (crosses(b, c, x, z) != crosses(c, a, x, z));
    if (covers && height_at(a, b, c, x, z) > p.y) odd = !odd;
  }
  return odd;
}

double MeshIndex::distance(Vec3d p, double limit) const {
  if (mesh_->vertices.empty()) return limit;
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < min_[axis] - limit || p[axis] > max_[axis] + limit) return limit;
  }
  double nearest = limit;
  for (int z = column(p.z - limit, 1); z <= column(p.z + limit, 1); ++z) {
    for (int x = column(p.x - limit, 0); x <= column(p.x + limit, 0); ++x) {
      const std::size_t at =
          static_cast<std::size_t>(z) * static_cast<std::size_t>(columns_[0]) + static_cast<std::size_t>(x);
      for (std::uint32_t i = begin_[at]; i < begin_[at + 1]; ++i) {
        const auto& [ia, ib, ic] = mesh_->triangles[triangles_[i]];
        const Vec3d a = mesh_->vertices[ia], b = mesh_->vertices[ib], c = mesh_->vertices[ic];
        const bool above = std::min({a.y, b.y, c.y}) > p.y + nearest, below = std::max({a.y, b.y, c.y}) < p.y - nearest;
        if (!above && !below) nearest = std::min(nearest, distance_to_triangle(p, a, b, c));
      }
    }
  }
  return nearest;
}

}  // namespace curlew
