#include "render/walls.h"

#include "render/programs.h"

namespace curlew {
namespace {

// Face 2 axis + side, as in Domain::walls.
bool is_wall(const Domain& domain, int axis, int side) {
  return !domain.periodic[static_cast<std::size_t>(axis)] &&
         domain.walls[static_cast<std::size_t>(2 * axis + side)].kind != WallKind::open;
}

double plane_of(const Domain& domain, int axis, int side) { return side ? domain.max[axis] : domain.min[axis]; }

// Do we see the face from inside, through the water?
bool behind(const Domain& domain, int axis, int side, Vec3d eye) {
  const double plane = plane_of(domain, axis, side);
  return side ? eye[axis] < plane : eye[axis] > plane;
}

}  // namespace

std::vector<WallEdge> wall_edges(const Domain& domain, int dimension, Vec3d eye) {
  std::vector<WallEdge> edges;
  for (int along = 0; along < dimension; ++along) {
    const int a = (along + 1) % 3, b = (along + 2) % 3;
    for (int side = 0; side < 4; ++side) {
      const int side_a = side & 1, side_b = side >> 1;
      // In 2D the z axis has one plane only, which is not a wall.
      if (dimension == 2 && ((a == 2 && side_a) || (b == 2 && side_b))) continue;
      Vec3d from;
      from[along] = domain.min[along];
      from[a] = plane_of(domain, a, side_a);
      from[b] = plane_of(domain, b, side_b);
      Vec3d to = from;
      to[along] = domain.max[along];
      const bool wall_a = !(dimension == 2 && a == 2) && is_wall(domain, a, side_a);
      const bool wall_b = !(dimension == 2 && b == 2) && is_wall(domain, b, side_b);
      const bool front = dimension == 3 && !behind(domain, a, side_a, eye) && !behind(domain, b, side_b, eye);
      edges.push_back({from, to, (wall_a || wall_b ? 1.0 : 0.3) * (front ? 0.5 : 1.0)});
    }
  }
  return edges;
}

std::vector<WallFace> back_faces(const Domain& domain, int dimension, Vec3d eye) {
  std::vector<WallFace> faces;
  if (dimension == 2) return faces;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const bool floor = axis == 1 && side == 0;
      if (floor || !is_wall(domain, axis, side) || !behind(domain, axis, side, eye)) continue;
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      WallFace face;
      for (int corner = 0; corner < 4; ++corner) {
        Vec3d& p = face[static_cast<std::size_t>(corner)];
        p[axis] = plane_of(domain, axis, side);
        p[a] = plane_of(domain, a, corner & 1);
        p[b] = plane_of(domain, b, corner >> 1);
      }
      faces.push_back(face);
    }
  return faces;
}

WallLayer::WallLayer()
    : edge_program_(gl::link_program("wall_edge.vert", "wall_edge.frag")),
      face_program_(gl::link_program("wall_face.vert", "wall_face.frag")),
      nothing_(gl::make_vertex_array()) {}

void WallLayer::draw(const FrameGeometry& geometry, const View& view, const Theme& theme, double line_width,
                     GLuint depth) {
  const Domain& domain = geometry.domain;
  glBindVertexArray(nothing_);
  glBindTextureUnit(0, depth);

  std::vector<Vec3> corners;
  for (const WallFace& face : back_faces(domain, geometry.dimension, view.position))
    for (const std::size_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) corners.push_back(to_float(face[corner]));
  faces_.upload(std::span<const Vec3>(corners));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, faces_.name());
  gl::set(face_program_, "opacity", theme.wall_opacity);
  glUseProgram(face_program_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));

  std::vector<Vec3> ends;
  for (const WallEdge& edge : wall_edges(domain, geometry.dimension, view.position)) {
    Vec3 from = to_float(edge.from);
    from.w = static_cast<float>(edge.opacity);
    ends.push_back(from);
    ends.push_back(to_float(edge.to));
  }
  edges_.upload(std::span<const Vec3>(ends));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, edges_.name());
  gl::set(edge_program_, "line_width", static_cast<float>(line_width));
  glUseProgram(edge_program_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * ends.size()));
}

}  // namespace curlew
