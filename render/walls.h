// The box in which the scene happens: fine edges, and the faces behind the water faintly filled.
#pragma once

#include <vector>

#include "render/camera.h"
#include "render/gl.h"
#include "render/theme.h"
#include "sim/core/frame.h"

namespace curlew {

struct WallEdge {
  Vec3d from, to;
  double opacity;  // 1, less where the edge lies before the water or bounds no wall
};
using WallFace = std::array<Vec3d, 4>;

// Open and periodic faces are no walls: they are not filled, and an edge between two of them is only hinted at.
std::vector<WallEdge> wall_edges(const Domain& domain, int dimension, Vec3d eye);
std::vector<WallFace> back_faces(const Domain& domain, int dimension, Vec3d eye);

class WallLayer {
 public:
  WallLayer();
  // Over the bound picture, behind what `depth` says is nearer.
  void draw(const FrameGeometry& geometry, const View& view, const Theme& theme, double line_width, GLuint depth);

 private:
  gl::Program edge_program_, face_program_;
  gl::VertexArray nothing_;
  gl::Buffer edges_, faces_;
};

}  // namespace curlew
