// What a mesh of a surface must be, whatever it is of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "sim/surface/surface_mesh.h"

namespace curlew::test {

// Directed sides of triangles that do not have exactly one partner in the other direction: 0 where every edge belongs
// to exactly two triangles, both facing the same way.
inline std::size_t unpaired_sides(const SurfaceMesh& mesh) {
  std::vector<std::uint64_t> sides, partners;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = t[k], b = t[(k + 1) % 3];
      sides.push_back(a << 32 | b);
      partners.push_back(b << 32 | a);
    }
  }
  std::sort(sides.begin(), sides.end());
  std::sort(partners.begin(), partners.end());
  std::size_t wrong = 0;
  for (std::size_t k = 1; k < sides.size(); ++k) wrong += sides[k] == sides[k - 1] ? 1 : 0;
  std::vector<std::uint64_t> lone;
  std::set_symmetric_difference(sides.begin(), sides.end(), partners.begin(), partners.end(), std::back_inserter(lone));
  return wrong + lone.size();
}

// Vertices whose triangles are not one fan around them.
inline std::size_t pinched_vertices(const SurfaceMesh& mesh) {
  std::vector<std::map<std::uint32_t, std::uint32_t>> next(mesh.position.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) next[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
  }
  std::size_t pinched = 0;
  for (const auto& around : next) {
    if (around.empty()) {
      ++pinched;  // a vertex of no triangle
      continue;
    }
    std::size_t steps = 0;
    std::uint32_t at = around.begin()->first;
    do {
      const auto found = around.find(at);
      if (found == around.end()) break;
      at = found->second;
      ++steps;
    } while (at != around.begin()->first && steps <= around.size());
    if (steps != around.size()) ++pinched;
  }
  return pinched;
}

// The sum over triangles of f(a, b, c), of their corners.
template <class F>
double triangle_sum(const SurfaceMesh& mesh, F&& f) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += f(to_double(mesh.position[t[0]]), to_double(mesh.position[t[1]]), to_double(mesh.position[t[2]]));
  return sum;
}

// By the divergence theorem, m^3.
inline double enclosed_volume(const SurfaceMesh& mesh) {
  return triangle_sum(mesh, [](Vec3d a, Vec3d b, Vec3d c) { return dot(a, cross(b, c)) / 6; });
}

inline double area(const SurfaceMesh& mesh) {
  return triangle_sum(mesh, [](Vec3d a, Vec3d b, Vec3d c) { return 0.5 * length(cross(b - a, c - a)); });
}

// The share of triangles' corners whose normal points to the triangle's outer side, of those triangles that have one.
inline double outward_normals(const SurfaceMesh& mesh, double least_area) {
  double outward = 0, all = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d a = to_double(mesh.position[t[0]]), b = to_double(mesh.position[t[1]]),
                c = to_double(mesh.position[t[2]]);
    const Vec3d face = cross(b - a, c - a);
    if (length(face) < 2 * least_area) continue;
    for (const std::uint32_t v : t) {
      all += 1;
      outward += dot(face, to_double(mesh.normal[v])) > 0 ? 1 : 0;
    }
  }
  return all > 0 ? outward / all : 1;
}

}  // namespace curlew::test
