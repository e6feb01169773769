#include "sim/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include "sim/core/error.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json.h"
#include "sim/scene/mesh_formats.h"

namespace curlew {
namespace {

struct PlaceHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double x : p) hash = hash * 1000003 + std::hash<double>()(x);
    return hash;
  }
};

// Vertices with the same three numbers become one; triangles that then name a vertex twice go.
TriangleMesh joined(const TriangleMesh& raw) {
  TriangleMesh mesh;
  std::unordered_map<std::array<double, 3>, std::uint32_t, PlaceHash> known;
  const auto vertex = [&](std::uint32_t index) {
    const Vec3d p = raw.vertices[index];
    const std::array<double, 3> key{p.x + 0.0, p.y + 0.0, p.z + 0.0};  // -0 becomes 0
    const auto [entry, is_new] = known.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back({key[0], key[1], key[2]});
    return entry->second;
  };
  for (const auto& triangle : raw.triangles) {
    const std::uint32_t a = vertex(triangle[0]), b = vertex(triangle[1]), c = vertex(triangle[2]);
    if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
  }
  return mesh;
}

// How often each edge is used, forwards minus backwards and in all.
struct EdgeUse {
  int used = 0, balance = 0;
};

std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse> edge_uses(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      EdgeUse& edge = edges[{std::min(a, b), std::max(a, b)}];
      ++edge.used;
      edge.balance += a < b ? 1 : -1;
    }
  }
  return edges;
}

Vec3d rotated(Vec3d p, Vec3d degrees) {
  for (int axis = 0; axis < 3; ++axis) {
    if (degrees[axis] == 0) continue;
    const double angle = degrees[axis] * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double pu = p[u], pv = p[v];
    p[u] = c * pu - s * pv;
    p[v] = s * pu + c * pv;
  }
  return p;
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file) {
  constexpr std::uintmax_t largest = std::uintmax_t{512} << 20U;
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  const auto read = kind == ".obj" ? read_obj : kind == ".ply" ? read_ply : kind == ".stl" ? read_stl : nullptr;
  if (read == nullptr) {
    throw InputError(file.string() + ": has the extension " + in_quotes(kind) + ", expected .obj, .ply or .stl");
  }
  TriangleMesh mesh = joined(read(read_file(file, largest, "a triangle mesh"), file));
  if (mesh.triangles.empty()) throw InputError(file.string() + ": holds no triangle, expected a triangle mesh");
  if (signed_volume(mesh) < 0) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

void require_closed(const TriangleMesh& mesh, const std::string& place) {
  const auto edges = edge_uses(mesh);
  const auto count = [&](auto&& test) { return std::to_string(std::count_if(edges.begin(), edges.end(), test)); };
  const auto fail = [&](const std::string& number, const std::string& what) {
    throw InputError(place + ": " + number + " of " + std::to_string(edges.size()) + " edges " + what +
                     ", expected a closed surface, in which every edge belongs to two triangles");
  };
  const std::string open = count([](const auto& edge) { return edge.second.used == 1; });
  if (open != "0") fail(open, "are open");
  const std::string crowded = count([](const auto& edge) { return edge.second.used > 2; });
  if (crowded != "0") fail(crowded, "belong to more than two triangles");
  const std::string twisted = count([](const auto& edge) { return edge.second.balance != 0; });
  if (twisted != "0") fail(twisted, "lie between triangles that face opposite ways");
}

TriangleMesh transformed(TriangleMesh mesh, double scale, Vec3d rotation, Vec3d translation) {
  for (Vec3d& vertex : mesh.vertices) vertex = rotated(scale * vertex, rotation) + translation;
  return mesh;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  const Vec3d origin = mesh.vertices[0];  // near the mesh: far from it the terms would cancel
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += dot(mesh.vertices[a] - origin, cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin));
  }
  return sum / 6;
}

double surface_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  }
  return sum / 2;
}

}  // namespace curlew
