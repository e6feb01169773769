// Text as pixels: letters of the stroke font drawn at one size into an atlas, and strings laid out from it.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace curlew {

// Where a letter lies in the atlas, and how it sits on the line. Pixels, y down.
struct AtlasGlyph {
  int x = 0, y = 0, width = 0, height = 0;  // in the atlas
  int left = 0, top = 0;                    // of the pixels, from the pen's place on the baseline
  double advance = 0;
};

// A letter of a laid out string: its pixels go to (x, y).
struct PlacedGlyph {
  const AtlasGlyph* glyph;
  int x = 0, y = 0;
};

struct TextLine {
  std::vector<PlacedGlyph> glyphs;
  double width = 0;
};

// Letters whose capitals are cap_height pixels high; `^` before digits raises them ("kg/m^3").
class FontAtlas {
 public:
  explicit FontAtlas(int cap_height);

  // With the pen starting at x on the baseline y.
  TextLine lay_out(std::string_view utf8, double x, double y) const;
  double width_of(std::string_view utf8) const { return lay_out(utf8, 0, 0).width; }

  int cap_height() const { return cap_height_; }
  int line_height() const { return (cap_height_ * 19 + 5) / 10; }

  // Two bytes a pixel: how much of it a letter covers, and how much a wider halo around the letter does.
  const std::vector<std::uint8_t>& pixels() const { return pixels_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Face {
    double scale;  // pixels a font unit
    std::map<std::uint32_t, AtlasGlyph> glyphs;
  };
  void draw_face(Face& face, double pen, int& x, int& y, int& row_height);
  const AtlasGlyph& find(const Face& face, std::uint32_t code) const;

  int cap_height_;
  int width_ = 512, height_ = 0;
  std::vector<std::uint8_t> pixels_;
  Face normal_, raised_;
};

}  // namespace curlew
