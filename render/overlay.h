// Text and plain bars over the finished picture.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "render/gl.h"
#include "render/text.h"
#include "render/theme.h"

namespace curlew {

struct Ink {
  float r, g, b, a;  // sRGB
};

// Collects a picture's letters and bars, then draws them at once. Pixels from the top left corner, y down.
class Overlay {
 public:
  Overlay();

  void begin(int width, int height, const Theme& theme);
  const FontAtlas& font(int cap_height);
  void text(int cap_height, std::string_view utf8, double x, double baseline);
  void bar(double left, double top, double right, double bottom, Ink top_ink, Ink bottom_ink);
  void end();  // into the bound picture

  Ink ink() const { return ink_; }
  Ink paper() const { return paper_; }

 private:
  struct Vertex {
    float x, y, u, v;
    Ink ink;
  };
  struct Font {
    FontAtlas atlas;
    gl::Texture texture;
    std::vector<Vertex> letters;
  };
  Font& font_of(int cap_height);
  void draw(const std::vector<Vertex>& vertices);

  gl::Program program_;
  gl::VertexArray quads_;
  gl::Buffer buffer_;
  std::map<int, Font> fonts_;
  std::vector<Vertex> bars_;
  int width_ = 0, height_ = 0;
  Ink ink_{}, paper_{};
};

}  // namespace curlew
