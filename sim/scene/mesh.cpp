#include "sim/scene/mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/scene/json.h"
#include "sim/scene/mesh_precheck.h"

namespace curlew {
namespace {

struct PlaceHash {
  std::size_t operator()(const std::array<float, 3>& p) const {
    std::size_t hash = 0;
    for (const float x : p) hash = hash * 1000003 + std::hash<float>()(x);
    return hash;
  }
};

// Collects triangles; vertices with the same three numbers become one.
class MeshJoiner {
 public:
  explicit MeshJoiner(const std::filesystem::path& file) : file_(file) {}

  void add(const aiMesh& part) {
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = vertex(part, face.mIndices[k]);
      const auto [a, b, c] = triangle;
      if (a != b && b != c && c != a) mesh.triangles.push_back(triangle);
    }
  }

  TriangleMesh mesh;

 private:
  std::uint32_t vertex(const aiMesh& part, unsigned index) {
    if (index >= part.mNumVertices) {
      throw InputError(file_.string() + ": a triangle names vertex " + std::to_string(index) + " of " +
                       std::to_string(part.mNumVertices) + ", expected a vertex that the file holds");
    }
    const aiVector3D p = part.mVertices[index];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InputError(file_.string() + ": vertex " + std::to_string(index) +
                       " has a coordinate that is not a finite number, expected three finite numbers");
    }
    const std::array<float, 3> key{p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};  // -0 becomes 0
    const auto [entry, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back({p.x, p.y, p.z});
    return entry->second;
  }

  const std::filesystem::path& file_;
  std::unordered_map<std::array<float, 3>, std::uint32_t, PlaceHash> known_;
};

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
  precheck_mesh_file(file);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (scene == nullptr) throw InputError(file.string() + ": damaged or cut short, expected a triangle mesh");
  MeshJoiner joiner(file);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) joiner.add(*scene->mMeshes[m]);
  if (joiner.mesh.triangles.empty()) throw InputError(file.string() + ": holds no triangle, expected a triangle mesh");
  if (signed_volume(joiner.mesh) < 0) {
    for (auto& triangle : joiner.mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return std::move(joiner.mesh);
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
