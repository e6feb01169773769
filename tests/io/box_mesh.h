// A closed mesh as the text or bytes of each format that we read.
#pragma once

#include <array>
#include <cstdint>
#include <sstream>
#include <string>

#include "sim/scene/scene.h"

namespace curlew::test {

// A box of 1 by 2 by 3, its faces two triangles each.
inline TriangleMesh box() {
  TriangleMesh mesh;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 2.0}) {
      for (const double z : {0.0, 3.0}) mesh.vertices.push_back({x, y, z});
    }
  }
  using Quad = std::array<std::uint32_t, 4>;
  for (const auto& [a, b, c, d] :
       {Quad{0, 1, 3, 2}, Quad{4, 6, 7, 5}, Quad{0, 4, 5, 1}, Quad{2, 3, 7, 6}, Quad{0, 2, 6, 4}, Quad{1, 5, 7, 3}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::string obj_text(const TriangleMesh& mesh) {
  std::ostringstream text;
  for (const Vec3d& v : mesh.vertices) text << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& [a, b, c] : mesh.triangles) text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  return text.str();
}

inline std::string ply_text(const TriangleMesh& mesh, bool binary) {
  std::ostringstream text;
  text << "ply\nformat " << (binary ? "binary_little_endian" : "ascii") << " 1.0\nelement vertex "
       << mesh.vertices.size() << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
       << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::string bytes;
  for (const Vec3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) put(bytes, static_cast<float>(v[k]));
    if (!binary) text << v.x << ' ' << v.y << ' ' << v.z << '\n';
  }
  for (const auto& triangle : mesh.triangles) {
    put(bytes, std::uint8_t{3});
    for (const std::uint32_t index : triangle) put(bytes, index);
    if (!binary) text << "3 " << triangle[0] << ' ' << triangle[1] << ' ' << triangle[2] << '\n';
  }
  return text.str() + (binary ? bytes : "");
}

inline std::string stl_text(const TriangleMesh& mesh, bool binary) {
  std::ostringstream text;
  text << "solid box\n";
  std::string bytes(80, ' ');
  put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) put(bytes, 0.0F);
    for (const std::uint32_t index : triangle) {
      const Vec3d v = mesh.vertices[index];
      for (int k = 0; k < 3; ++k) put(bytes, static_cast<float>(v[k]));
      text << "vertex " << v.x << ' ' << v.y << ' ' << v.z << '\n';
    }
    put(bytes, std::uint16_t{0});
    text << "endloop\nendfacet\n";
  }
  text << "endsolid box\n";
  return binary ? bytes : text.str();
}

}  // namespace curlew::test
