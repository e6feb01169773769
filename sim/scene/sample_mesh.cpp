#include "sim/scene/sample_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "sim/scene/point_grid.h"

namespace curlew {
namespace {

constexpr double edge_distance = 0.6;  // least distance of samples on sharp edges, in spacings
constexpr double candidate_gap = 0.3;  // longest edge of a face piece that gives one candidate, in spacings
// Least distance on faces, in spacings. Random packing at 0.78 leaves 1.05 to 1.16 samples per spacing squared and no
// place farther than 0.85 spacings from one (tests/unit/sampling_surface.cpp). Passes with falling distances changed
// neither.
constexpr double face_distance = 0.78;

// All three points beyond, or in, one face of the domain. Periodic faces are no walls.
bool behind_wall(std::span<const Vec3d> corners, const Domain& domain, int dimension) {
  for (int axis = 0; axis < dimension; ++axis) {
    const double slack = 1e-9 * (domain.max[axis] - domain.min[axis]);
    const auto low = [&](Vec3d p) { return p[axis] <= domain.min[axis] + slack; };
    const auto high = [&](Vec3d p) { return p[axis] >= domain.max[axis] - slack; };
    if (std::all_of(corners.begin(), corners.end(), low) || std::all_of(corners.begin(), corners.end(), high))
      return true;
  }
  return false;
}

// Edges between triangles whose normals differ by more than 30 degrees.
std::vector<std::pair<Vec3d, Vec3d>> sharp_edges(const TriangleMesh& mesh, const std::vector<std::uint32_t>& chosen) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<Vec3d>> normals;
  std::vector<std::pair<Vec3d, Vec3d>> sharp;
  for (const std::uint32_t t : chosen) {
    const auto& triangle = mesh.triangles[t];
    const Vec3d a = mesh.vertices[triangle[0]];
    Vec3d normal = cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a);
    const double size = length(normal);
    if (size == 0) continue;
    normal = (1 / size) * normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      auto& other = normals[{low, high}];
      constexpr double cosine = 0.866;
      if (other && dot(*other, normal) < cosine) sharp.emplace_back(mesh.vertices[low], mesh.vertices[high]);
      other = normal;
    }
  }
  return sharp;
}

// Halves the triangle across its longest edge until the pieces are small; their centres are the candidates. Pieces
// outside the region are dropped early.
void add_candidates(std::array<Vec3d, 3> corners, double gap, const Domain& region, std::vector<Vec3d>& candidates) {
  if (behind_wall(corners, region, 3)) return;
  std::size_t longest = 0;
  const auto edge = [&](std::size_t k) { return length(corners[(k + 1) % 3] - corners[k]); };
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) longest = edge(k) > edge(longest) ? k : longest;
  const Vec3d a = corners[longest], b = corners[(longest + 1) % 3], c = corners[(longest + 2) % 3];
  if (edge(longest) <= gap) {
    candidates.push_back((1.0 / 3) * (a + b + c));
    return;
  }
  const Vec3d middle = 0.5 * (a + b);
  add_candidates({a, middle, c}, gap, region, candidates);
  add_candidates({middle, b, c}, gap, region, candidates);
}

// A fixed, well mixed order: packing in the order of a grid would copy the grid's direction.
void shuffle(std::vector<Vec3d>& points) {
  std::uint64_t state = 0x9E3779B97F4A7C15U;
  for (std::size_t i = points.size(); i > 1; --i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    std::swap(points[i - 1], points[static_cast<std::size_t>((state >> 33U) % i)]);
  }
}

class Packing {
 public:
  explicit Packing(double spacing, const Domain& domain) : grid_(spacing, domain) {}

  void try_add(Vec3d p, double radius) {
    if (grid_.any_within(p, radius)) return;
    grid_.add(p);
    points.push_back(p);
  }

  std::vector<Vec3d> points;

 private:
  PointGrid grid_;
};

// The share of the way from a to b at which the line enters the region, and that at which it leaves it; the first is
// the larger where the line misses it.
std::pair<double, double> inside_part(Vec3d a, Vec3d b, const Domain& region) {
  double first = 0, last = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = b[axis] - a[axis], low = region.min[axis] - a[axis], high = region.max[axis] - a[axis];
    if (way == 0) {
      if (low > 0 || high < 0) last = -1;
      continue;
    }
    first = std::max(first, std::min(low / way, high / way));
    last = std::min(last, std::max(low / way, high / way));
  }
  return {first, last};
}

// Ends first, then the inside of each edge cut evenly, as far as it lies in the region.
void pack_edges(const std::vector<std::pair<Vec3d, Vec3d>>& edges, double d, const Domain& region, Packing& packing) {
  const double radius = edge_distance * d * (1 - 1e-9);
  for (const auto& [a, b] : edges) {
    packing.try_add(a, radius);
    packing.try_add(b, radius);
  }
  for (const auto& [a, b] : edges) {
    const double ratio = length(b - a) / d;
    const double n = ratio > 1.2 * std::round(ratio) ? std::ceil(ratio) : std::round(ratio);
    const auto [first, last] = inside_part(a, b, region);
    const double end = std::min(n - 1, last * n);
    for (double k = std::max(1.0, std::ceil(first * n)); k <= end; ++k) packing.try_add(a + k / n * (b - a), radius);
  }
}

}  // namespace

std::vector<Vec3d> sample_mesh(const TriangleMesh& mesh, double spacing, const Domain& domain) {
  Domain reachable = domain;
  for (int axis = 0; axis < 3; ++axis) {
    reachable.min[axis] -= 2 * spacing;
    reachable.max[axis] += 2 * spacing;
  }
  std::vector<std::uint32_t> chosen;
  std::vector<Vec3d> candidates;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [ia, ib, ic] = mesh.triangles[t];
    const Vec3d a = mesh.vertices[ia], b = mesh.vertices[ib], c = mesh.vertices[ic];
    if (behind_wall(std::array{a, b, c}, domain, 3)) continue;
    chosen.push_back(t);
    add_candidates({a, b, c}, candidate_gap * spacing, reachable, candidates);
  }
  shuffle(candidates);
  Packing packing(spacing, domain);
  pack_edges(sharp_edges(mesh, chosen), spacing, reachable, packing);
  for (const Vec3d& p : candidates) packing.try_add(p, face_distance * spacing);
  if (packing.points.empty() && !chosen.empty() && !candidates.empty()) packing.points.push_back(candidates.front());
  return std::move(packing.points);
}

std::vector<Vec3d> sample_outline(const Heightfield& field, double spacing, const Domain& domain) {
  std::vector<Vec3d> top;
  for (int column = 0; column < field.columns; ++column) {
    const double x = field.min.x + (field.max.x - field.min.x) * column / (field.columns - 1);
    top.push_back({x, std::clamp(field.heights[static_cast<std::size_t>(column)], field.min.y, field.max.y), 0});
  }
  std::vector<std::vector<Vec3d>> lines{top,
                                        {{field.min.x, field.min.y, 0}, top.front()},
                                        {{field.max.x, field.min.y, 0}, top.back()},
                                        {{field.min.x, field.min.y, 0}, {field.max.x, field.min.y, 0}}};
  Packing packing(spacing, domain);
  for (const auto& line : lines) {
    if (behind_wall(line, domain, 2)) continue;
    double whole = 0;
    for (std::size_t k = 1; k < line.size(); ++k) whole += length(line[k] - line[k - 1]);
    const double step = whole / std::max(1.0, std::round(whole / spacing));
    double due = 0;  // arc length left to the next sample
    for (std::size_t k = 1; k < line.size(); ++k) {
      const double piece = length(line[k] - line[k - 1]);
      for (; due <= piece * (1 + 1e-12); due += step) {
        packing.try_add(line[k - 1] + (piece > 0 ? due / piece : 0) * (line[k] - line[k - 1]), edge_distance * spacing);
      }
      due -= piece;
    }
    packing.try_add(line.back(), edge_distance * spacing);
  }
  return std::move(packing.points);
}

}  // namespace curlew
