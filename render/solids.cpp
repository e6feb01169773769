#include "render/solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/programs.h"

namespace curlew {

std::vector<MeshVertex> drawn_triangles(const TriangleMesh& mesh) {
  const double crease = std::cos(40 * std::numbers::pi / 180);
  std::vector<Vec3d> face;  // twice the area, along the normal
  face.reserve(mesh.triangles.size());
  std::vector<std::vector<std::size_t>> around(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    for (const auto v : t) around[v].push_back(face.size());
    face.push_back(cross(b - a, c - a));
  }

  std::vector<MeshVertex> out;
  out.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < face.size(); ++i) {
    const double area = length(face[i]);
    if (!(area > 0)) continue;
    for (const auto v : mesh.triangles[i]) {
      Vec3d normal;
      for (const std::size_t j : around[v])
        if (dot(face[i], face[j]) >= crease * area * length(face[j])) normal += face[j];
      const Vec3 p = to_float(mesh.vertices[v]), n = to_float((1 / length(normal)) * normal);
      out.push_back({p.x, p.y, p.z, n.x, n.y, n.z});
    }
  }
  return out;
}

namespace {

std::vector<MeshVertex> moved(std::vector<MeshVertex> vertices, std::span<const std::size_t> ends,
                              std::span<const Vec3d> offsets) {
  std::size_t k = 0;
  for (std::size_t body = 0; body < ends.size(); ++body) {
    const Vec3 by = to_float(offsets[body]);
    for (; k < ends[body]; ++k) {
      vertices[k].x += by.x;
      vertices[k].y += by.y;
      vertices[k].z += by.z;
    }
  }
  return vertices;
}

}  // namespace

SolidLayer::SolidLayer()
    : mesh_program_(gl::link_program("mesh.vert", "mesh.frag")),
      floor_program_(gl::link_program("floor.vert", "floor.frag")),
      triangles_(gl::make_vertex_array()),
      nothing_(gl::make_vertex_array()) {
  for (const GLuint attribute : {0u, 1u}) {
    glEnableVertexArrayAttrib(triangles_, attribute);
    glVertexArrayAttribFormat(triangles_, attribute, 3, GL_FLOAT, GL_FALSE, 12 * attribute);
    glVertexArrayAttribBinding(triangles_, attribute, 0);
  }
}

void SolidLayer::upload(const std::shared_ptr<const FrameGeometry>& geometry, std::span<const Vec3d> offsets) {
  const bool same_place = std::equal(offsets.begin(), offsets.end(), offsets_.begin(), offsets_.end());
  if (geometry == geometry_ && same_place) return;
  if (geometry != geometry_ || unmoved_.size() != count_) {  // or given back below
    unmoved_.clear();
    ends_.clear();
    for (const FrameBody& body : geometry->bodies) {
      const auto part = drawn_triangles(body.surface);
      unmoved_.insert(unmoved_.end(), part.begin(), part.end());
      ends_.push_back(unmoved_.size());
    }
    geometry_ = geometry;
  }
  count_ = unmoved_.size();
  offsets_.assign(offsets.begin(), offsets.end());
  if (offsets.empty()) {
    vertices_.upload(std::span<const MeshVertex>(unmoved_));
    unmoved_ = std::vector<MeshVertex>();
    return;
  }
  vertices_.upload(std::span<const MeshVertex>(moved(unmoved_, ends_, offsets)));
}

void SolidLayer::draw_bodies() {
  if (count_ == 0) return;
  glUseProgram(mesh_program_);
  glBindVertexArray(triangles_);
  glVertexArrayVertexBuffer(triangles_, 0, vertices_.name(), 0, sizeof(MeshVertex));
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count_));
}

void SolidLayer::draw_floor() {
  glUseProgram(floor_program_);
  glBindVertexArray(nothing_);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void SolidLayer::draw_shadow(GLuint program) {
  if (count_ == 0) return;
  glUseProgram(program);
  glBindVertexArray(triangles_);
  glVertexArrayVertexBuffer(triangles_, 0, vertices_.name(), 0, sizeof(MeshVertex));
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count_));
}

}  // namespace curlew
