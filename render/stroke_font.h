// A small sans-serif font of our own, drawn with a round pen. Each letter is a list of lines and arcs, so that text is
// sharp at every size and no font file is needed.
#pragma once

#include <cstdint>
#include <vector>

namespace curlew {

struct Point2 {
  double x = 0, y = 0;
};

// Units: capitals and digits are 10 high, small letters 7; the baseline is y = 0, y up. The pen is not included.
struct StrokeGlyph {
  double width = 0;  // from the leftmost pen position, x = 0, to the rightmost
  std::vector<std::vector<Point2>> strokes;
};

constexpr double kCapHeight = 10, kDescent = 3.2, kAscent = 11.2;
constexpr double kLetterGap = 2.6;  // between the pens of neighbours
constexpr double kPenWidth = 1.25;

// Of a Unicode code point: ASCII and a few signs of units; an empty box for what is not there.
StrokeGlyph stroke_glyph(std::uint32_t code_point);

}  // namespace curlew
