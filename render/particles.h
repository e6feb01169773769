// The particles on the graphics side: their arrays, their spheres in the picture and their points in the shadow map.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "render/gl.h"
#include "render/theme.h"
#include "sim/core/vec.h"

namespace curlew {

class ParticleLayer {
 public:
  ParticleLayer();

  // Positions with the factor on the drawn radius in w, and one value each or none.
  void upload(std::span<const Vec3> positions, std::span<const float> values);
  // Where others throw shadows than are drawn.
  void upload_shadow(std::span<const Vec3> positions);

  // Colours by frame.value through the map, or the theme's plain water where there are no values.
  void set_colours(std::string_view map, const Colour& water, std::array<double, 2> range, bool coloured);

  void draw() { draw(program_); }         // into the bound G-buffer
  void draw(const gl::Program& program);  // with another fragment shader behind sphere.vert
  void draw_shadow(GLuint program);       // into the bound shadow map, with a program that takes positions

 private:
  gl::Program program_;
  gl::VertexArray quads_, points_;
  gl::Buffer positions_, values_, indices_, shadow_positions_;
  gl::Texture colours_;
  std::size_t count_ = 0, indexed_ = 0;
  std::optional<std::size_t> shadow_count_;  // of their own
};

}  // namespace curlew
