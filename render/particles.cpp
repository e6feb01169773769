#include "render/particles.h"

#include <cstdint>
#include <vector>

#include "render/colour_maps.h"
#include "render/programs.h"

namespace curlew {
namespace {

// Two triangles over the four corners of each quad. Indexed quads from one draw call: instancing costs llvmpipe a
// set-up per particle, and points are dropped when their centre leaves the picture.
std::vector<std::uint32_t> quad_indices(std::size_t quads) {
  std::vector<std::uint32_t> all;
  all.reserve(6 * quads);
  for (std::uint32_t i = 0; i < quads; ++i)
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) all.push_back(4 * i + corner);
  return all;
}

}  // namespace

ParticleLayer::ParticleLayer()
    : program_(gl::link_program("sphere.vert", "sphere.frag")),
      quads_(gl::make_vertex_array()),
      points_(gl::make_vertex_array()),
      colours_(gl::make_texture(GL_RGBA8, 256, 2)) {
  glEnableVertexArrayAttrib(points_, 0);
  glVertexArrayAttribFormat(points_, 0, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(points_, 0, 0);
}

void ParticleLayer::upload(std::span<const Vec3> positions, std::span<const float> values) {
  count_ = positions.size();
  shadow_count_.reset();
  positions_.upload(positions);
  values_.upload(values);
  if (count_ > indexed_) {
    indexed_ = count_ + count_ / 4;
    indices_.upload(std::span<const std::uint32_t>(quad_indices(indexed_)));
  }
}

void ParticleLayer::upload_shadow(std::span<const Vec3> positions) {
  shadow_count_ = positions.size();
  shadow_positions_.upload(positions);
}

void ParticleLayer::set_colours(std::string_view map, const Colour& water, std::array<double, 2> range, bool coloured) {
  std::vector<std::uint8_t> texels;
  texels.reserve(2 * 4 * 256);
  for (const Rgb c : colour_map(map)) texels.insert(texels.end(), {c.r, c.g, c.b, 255});
  for (int i = 0; i < 256; ++i) {
    for (const float c : water) texels.push_back(static_cast<std::uint8_t>(255 * linear_to_srgb(c) + 0.5f));
    texels.push_back(255);
  }
  glTextureSubImage2D(colours_, 0, 0, 0, 256, 2, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  gl::set(program_, "value_range", static_cast<float>(range[0]), static_cast<float>(1 / (range[1] - range[0])),
          coloured ? 1.f : 0.f, 0.f);
}

void ParticleLayer::draw(const gl::Program& program) {
  if (count_ == 0) return;
  glUseProgram(program);
  glBindVertexArray(quads_);
  glVertexArrayElementBuffer(quads_, indices_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, positions_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, values_.name());
  glBindTextureUnit(0, colours_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * count_), GL_UNSIGNED_INT, nullptr);
}

void ParticleLayer::draw_shadow(GLuint program) {
  const std::size_t count = shadow_count_.value_or(count_);
  if (count == 0) return;
  glUseProgram(program);
  glBindVertexArray(points_);
  glVertexArrayVertexBuffer(points_, 0, (shadow_count_ ? shadow_positions_ : positions_).name(), 0, sizeof(Vec3));
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count));
}

}  // namespace curlew
