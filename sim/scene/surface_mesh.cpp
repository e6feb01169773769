// Shapes as closed triangle meshes, for drawing.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/scene/heightfield.h"
#include "sim/scene/shapes.h"

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int segments = 64;

using Polygon = std::vector<Vec3d>;

// A fan over a convex polygon whose corners run counter-clockwise seen from outside.
void add_polygon(TriangleMesh& mesh, const Polygon& polygon) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), polygon.begin(), polygon.end());
  for (std::uint32_t k = 2; k < polygon.size(); ++k) mesh.triangles.push_back({first, first + k - 1, first + k});
}

// Between two rings with the same number of corners: caps and sides. The bottom ring runs counter-clockwise seen from
// the top ring.
TriangleMesh prism(const Polygon& bottom, const Polygon& top) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(bottom.size());
  mesh.vertices = bottom;
  mesh.vertices.insert(mesh.vertices.end(), top.begin(), top.end());
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    mesh.triangles.push_back({k, next, n + next});
    mesh.triangles.push_back({k, n + next, n + k});
    if (k >= 2) {
      mesh.triangles.push_back({0, k, k - 1});
      mesh.triangles.push_back({n, n + k - 1, n + k});
    }
  }
  return mesh;
}

Polygon ring(Vec3d centre, Vec3d u, Vec3d v) {
  Polygon points;
  for (int k = 0; k < segments; ++k) {
    const double angle = 2 * pi * k / segments;
    points.push_back(centre + std::cos(angle) * u + std::sin(angle) * v);
  }
  return points;
}

TriangleMesh cylinder_mesh(Vec3d from, Vec3d to, double radius) {
  const Vec3d axis = (1 / length(to - from)) * (to - from);
  const Vec3d other = std::abs(axis.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  Vec3d u = cross(axis, other);
  u = (1 / length(u)) * u;
  const Vec3d v = cross(axis, u);
  return prism(ring(from, radius * u, radius * v), ring(to, radius * u, radius * v));
}

TriangleMesh sphere_mesh(Vec3d centre, double radius) {
  constexpr int rows = segments / 2;
  TriangleMesh mesh;
  mesh.vertices = {centre - Vec3d{0, radius, 0}, centre + Vec3d{0, radius, 0}};
  const auto index = [](int row, int k) { return static_cast<std::uint32_t>(2 + (row - 1) * segments + k % segments); };
  for (int row = 1; row < rows; ++row) {
    const double angle = pi * row / rows, y = -radius * std::cos(angle), r = radius * std::sin(angle);
    const Polygon points = ring(centre + Vec3d{0, y, 0}, {0, 0, r}, {r, 0, 0});
    mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
  }
  for (int k = 0; k < segments; ++k) {
    mesh.triangles.push_back({0, index(1, k + 1), index(1, k)});
    mesh.triangles.push_back({1, index(rows - 1, k), index(rows - 1, k + 1)});
    for (int row = 1; row + 1 < rows; ++row) {
      mesh.triangles.push_back({index(row, k), index(row, k + 1), index(row + 1, k + 1)});
      mesh.triangles.push_back({index(row, k), index(row + 1, k + 1), index(row + 1, k)});
    }
  }
  return mesh;
}

Polygon rectangle(Vec3d min, Vec3d max, double z) {
  return {{min.x, min.y, z}, {max.x, min.y, z}, {max.x, max.y, z}, {min.x, max.y, z}};
}

TriangleMesh box_mesh(Vec3d min, Vec3d max) { return prism(rectangle(min, max, min.z), rectangle(min, max, max.z)); }

// The outline of a 2D strip with round ends.
Polygon strip(const Cylinder& c, double z) {
  const double heading = std::atan2(c.to.y - c.from.y, c.to.x - c.from.x);
  Polygon points;
  for (int k = 0; k <= segments; ++k) {
    const bool at_to = k <= segments / 2;
    const double angle = heading - pi / 2 + 2 * pi * (at_to ? k : k - 1) / segments;
    const Vec3d end = at_to ? c.to : c.from;
    points.push_back({end.x + c.radius * std::cos(angle), end.y + c.radius * std::sin(angle), z});
  }
  points.push_back(
      {c.from.x + c.radius * std::cos(heading - pi / 2), c.from.y + c.radius * std::sin(heading - pi / 2), z});
  return points;
}

// The part of a polygon behind the plane (Sutherland & Hodgman 1974); points on the cut are added to `cut`.
Polygon clipped(const Polygon& polygon, Vec3d point, Vec3d normal, Polygon& cut) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double da = dot(a - point, normal), db = dot(b - point, normal);
    if (da <= 0) kept.push_back(a);
    if ((da <= 0) != (db <= 0)) {
      kept.push_back(a + da / (da - db) * (b - a));
      cut.push_back(kept.back());
    }
  }
  return kept;
}

// What of the box lies behind the plane.
TriangleMesh half_space_mesh(Vec3d min, Vec3d max, const Plane& plane) {
  const Polygon low = rectangle(min, max, min.z), high = rectangle(min, max, max.z);
  std::vector<Polygon> faces{{low[3], low[2], low[1], low[0]}, high};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    faces.push_back({low[k], low[next], high[next], high[k]});
  }
  TriangleMesh mesh;
  Polygon cut;
  for (const Polygon& face : faces) add_polygon(mesh, clipped(face, plane.point, plane.normal, cut));
  if (cut.empty()) return mesh;
  // The lid: the points of the cut, put in order around their mean.
  Vec3d centre;
  for (const Vec3d& p : cut) centre += (1.0 / static_cast<double>(cut.size())) * p;
  const Vec3d u = cut[0] - centre, v = cross(plane.normal, u);
  const auto angle = [&](Vec3d p) { return std::atan2(dot(p - centre, v) / length(plane.normal), dot(p - centre, u)); };
  std::sort(cut.begin(), cut.end(), [&](Vec3d a, Vec3d b) { return angle(a) < angle(b); });
  add_polygon(mesh, cut);
  return mesh;
}

// 2D shapes are drawn this thick to either side of z = 0.
double half_thickness(const Domain& domain) {
  return 0.005 * std::max(domain.max.x - domain.min.x, domain.max.y - domain.min.y);
}

struct Mesher {
  int dimension;
  const Domain& domain;
  double t = half_thickness(domain);

  TriangleMesh operator()(const Box& b) const {
    if (dimension == 3) return box_mesh(b.min, b.max);
    return box_mesh({b.min.x, b.min.y, -t}, {b.max.x, b.max.y, t});
  }
  TriangleMesh operator()(const Sphere& s) const {
    if (dimension == 3) return sphere_mesh(s.centre, s.radius);
    return cylinder_mesh({s.centre.x, s.centre.y, -t}, {s.centre.x, s.centre.y, t}, s.radius);
  }
  TriangleMesh operator()(const Cylinder& c) const {
    return dimension == 3 ? cylinder_mesh(c.from, c.to, c.radius) : prism(strip(c, -t), strip(c, t));
  }
  TriangleMesh operator()(const Plane& p) const {
    if (dimension == 3) return half_space_mesh(domain.min, domain.max, p);
    return half_space_mesh({domain.min.x, domain.min.y, -t}, {domain.max.x, domain.max.y, t}, p);
  }
  TriangleMesh operator()(const Mesh& m) const { return *m.mesh; }
  TriangleMesh operator()(Heightfield h) const {
    if (dimension == 2) {
      h.min.z = -t;
      h.max.z = t;
    }
    return heightfield_mesh(h);
  }
};

}  // namespace

TriangleMesh surface_mesh(const Shape& shape, int dimension, const Domain& domain) {
  return std::visit(Mesher{dimension, domain}, shape);
}

}  // namespace curlew
