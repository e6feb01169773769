// Solids: bodies and the floor.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/gl.h"
#include "sim/core/frame.h"

namespace curlew {

// A corner of a triangle as it is drawn: six floats.
struct MeshVertex {
  float x, y, z;
  float nx, ny, nz;
};

// Three vertices a triangle. Faces that meet at less than 40 degrees share a normal there (weighted by area), others
// keep an edge: spheres come out round, boxes sharp. Triangles without area are left out.
std::vector<MeshVertex> drawn_triangles(const TriangleMesh& mesh);

class SolidLayer {
 public:
  SolidLayer();

  // Uploads the bodies unless this very geometry is already there, each moved by its offset (m); no offsets: none
  // moves.
  void upload(const std::shared_ptr<const FrameGeometry>& geometry, std::span<const Vec3d> offsets);

  void draw_bodies();
  void draw_floor();
  void draw_shadow(GLuint program);

 private:
  gl::Program mesh_program_, floor_program_;
  gl::VertexArray triangles_, nothing_;
  gl::Buffer vertices_;
  std::size_t count_ = 0;
  std::vector<MeshVertex> unmoved_;  // where the geometry has the bodies; kept only where they move
  std::vector<std::size_t> ends_;    // of the bodies in it
  std::vector<Vec3d> offsets_;
  std::shared_ptr<const FrameGeometry> geometry_;  // kept, so that no other can take its address
};

}  // namespace curlew
