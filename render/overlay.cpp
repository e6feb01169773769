#include "render/overlay.h"

#include <array>

#include "render/programs.h"

namespace curlew {
namespace {

Ink ink_of(const Colour& c) { return {linear_to_srgb(c[0]), linear_to_srgb(c[1]), linear_to_srgb(c[2]), 1}; }

constexpr float kPlain = -1;  // texel of a bar: left of the atlas

}  // namespace

Overlay::Overlay() : program_(gl::link_program("overlay.vert", "overlay.frag")), quads_(gl::make_vertex_array()) {
  GLuint offset = 0, attribute = 0;
  for (const GLint size : {2, 2, 4}) {
    glEnableVertexArrayAttrib(quads_, attribute);
    glVertexArrayAttribFormat(quads_, attribute, size, GL_FLOAT, GL_FALSE, offset);
    glVertexArrayAttribBinding(quads_, attribute, 0);
    offset += static_cast<GLuint>(size) * static_cast<GLuint>(sizeof(float));
    ++attribute;
  }
}

void Overlay::begin(int width, int height, const Theme& theme) {
  width_ = width;
  height_ = height;
  ink_ = ink_of(theme.ink);
  paper_ = ink_of(theme.paper);
  bars_.clear();
  for (auto& [size, font] : fonts_) font.letters.clear();
}

Overlay::Font& Overlay::font_of(int cap_height) {
  const auto found = fonts_.find(cap_height);
  if (found != fonts_.end()) return found->second;
  FontAtlas atlas(cap_height);
  gl::Texture texture = gl::make_texture(GL_RG8, atlas.width(), atlas.height());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture, 0, 0, 0, atlas.width(), atlas.height(), GL_RG, GL_UNSIGNED_BYTE, atlas.pixels().data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  return fonts_.emplace(cap_height, Font{std::move(atlas), std::move(texture), {}}).first->second;
}

const FontAtlas& Overlay::font(int cap_height) { return font_of(cap_height).atlas; }

void Overlay::text(int cap_height, std::string_view utf8, double x, double baseline) {
  Font& font = font_of(cap_height);
  for (const PlacedGlyph& placed : font.atlas.lay_out(utf8, x, baseline).glyphs) {
    const AtlasGlyph& g = *placed.glyph;
    for (const int corner : {0, 1, 2, 2, 1, 3}) {
      const int dx = (corner & 1) * g.width, dy = (corner >> 1) * g.height;
      font.letters.push_back({static_cast<float>(placed.x + dx), static_cast<float>(placed.y + dy),
                              static_cast<float>(g.x + dx), static_cast<float>(g.y + dy), ink_});
    }
  }
}

void Overlay::bar(double left, double top, double right, double bottom, Ink top_ink, Ink bottom_ink) {
  const std::array<double, 2> x{left, right}, y{top, bottom};
  for (const unsigned corner : {0u, 1u, 2u, 2u, 1u, 3u})
    bars_.push_back({static_cast<float>(x[corner & 1]), static_cast<float>(y[corner >> 1]), kPlain, kPlain,
                     corner >> 1 ? bottom_ink : top_ink});
}

void Overlay::draw(const std::vector<Vertex>& vertices) {
  buffer_.upload(std::span<const Vertex>(vertices));
  glVertexArrayVertexBuffer(quads_, 0, buffer_.name(), 0, sizeof(Vertex));
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
}

void Overlay::end() {
  glUseProgram(program_);
  glBindVertexArray(quads_);
  gl::set(program_, "picture", static_cast<float>(width_), static_cast<float>(height_), 0, 0);
  gl::set(program_, "paper", paper_.r, paper_.g, paper_.b, 0.55f);
  if (!bars_.empty()) draw(bars_);
  for (const auto& [size, font] : fonts_) {
    if (font.letters.empty()) continue;
    glBindTextureUnit(0, font.texture);
    draw(font.letters);
  }
}

}  // namespace curlew
