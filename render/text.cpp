#include "render/text.h"

#include <algorithm>
#include <cmath>

#include "render/stroke_font.h"

namespace curlew {
namespace {

constexpr std::uint32_t kBeyondAscii[] = {0xb0, 0xb5, 0xb7, 0xd7, 0x3bc, 0x3c9, 0x2212};
constexpr std::uint32_t kMissing = 0xfffd;

std::vector<std::uint32_t> all_code_points() {
  std::vector<std::uint32_t> codes(std::begin(kBeyondAscii), std::end(kBeyondAscii));
  for (std::uint32_t c = ' '; c < 127; ++c) codes.push_back(c);
  codes.push_back(kMissing);
  return codes;
}

double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, dd = dx * dx + dy * dy;
  const double t = dd > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / dd, 0.0, 1.0) : 0.0;
  return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

double distance_to(const StrokeGlyph& glyph, Point2 p) {
  double nearest = 1e9;
  for (const auto& stroke : glyph.strokes)
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i)
      nearest = std::min(nearest, distance_to_segment(p, stroke[i], stroke[i + 1]));
  return nearest;
}

std::uint8_t coverage(double distance_inside) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(distance_inside + 0.5, 0.0, 1.0)));
}

// The next code point of UTF-8 text, which is shortened by it; kMissing for what is not UTF-8.
std::uint32_t next_code_point(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (length == 0 || length > text.size()) {
    text.remove_prefix(1);
    return kMissing;
  }
  std::uint32_t code = length == 1 ? first : first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) code = code << 6 | (byte(i) & 0x3fu);
  text.remove_prefix(length);
  return code;
}

// A raised number follows: "^3", "^-2".
bool raises(std::string_view rest) {
  if (rest.starts_with('-')) rest.remove_prefix(1);
  return !rest.empty() && rest.front() >= '0' && rest.front() <= '9';
}

constexpr double kRaisedSize = 0.68, kRaisedBy = 0.52;  // of the capitals' height

}  // namespace

FontAtlas::FontAtlas(int cap_height)
    : cap_height_(cap_height),
      normal_{cap_height / kCapHeight, {}},
      raised_{kRaisedSize * cap_height / kCapHeight, {}} {
  // Thin pens turn grey on small letters, so a pen is never much thinner than a pixel.
  const double pen = std::max(1.15, kPenWidth * normal_.scale);
  int x = 0, y = 0, row_height = 0;
  draw_face(normal_, pen, x, y, row_height);
  draw_face(raised_, std::max(1.05, 0.82 * pen), x, y, row_height);
}

void FontAtlas::draw_face(Face& face, double pen, int& x, int& y, int& row_height) {
  const double halo = std::max(1.6, 0.22 * cap_height_);
  const int margin = static_cast<int>(std::ceil(0.5 * pen + halo + 1));
  for (const std::uint32_t code : all_code_points()) {
    const StrokeGlyph glyph = stroke_glyph(code);
    AtlasGlyph placed;
    placed.advance = (glyph.width + kLetterGap) * face.scale;
    placed.width = static_cast<int>(std::ceil(glyph.width * face.scale)) + 2 * margin;
    placed.height = static_cast<int>(std::ceil((kAscent + kDescent) * face.scale)) + 2 * margin;
    placed.left = -margin;
    placed.top = -static_cast<int>(std::ceil(kAscent * face.scale)) - margin;
    if (x + placed.width > width_) {
      x = 0;
      y += row_height;
      row_height = 0;
    }
    placed.x = x;
    placed.y = y;
    x += placed.width;
    row_height = std::max(row_height, placed.height);
    height_ = std::max(height_, y + row_height);
    pixels_.resize(2 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));

    for (int row = 0; row < placed.height; ++row)
      for (int column = 0; column < placed.width; ++column) {
        // The pen's place is the middle of a pixel, so that upright and level strokes come out sharp.
        const Point2 at{(column + placed.left) / face.scale, -(row + placed.top) / face.scale};
        const double away = distance_to(glyph, at) * face.scale;
        const std::size_t pixel = 2 * (static_cast<std::size_t>(placed.y + row) * static_cast<std::size_t>(width_) +
                                       static_cast<std::size_t>(placed.x + column));
        pixels_[pixel] = coverage(0.5 * pen - away);
        const double beyond = std::clamp(1 - (away - 0.5 * pen) / halo, 0.0, 1.0);
        pixels_[pixel + 1] = static_cast<std::uint8_t>(std::lround(255 * beyond));
      }
    face.glyphs.emplace(code, placed);
  }
}

const AtlasGlyph& FontAtlas::find(const Face& face, std::uint32_t code) const {
  const auto found = face.glyphs.find(code);
  return found == face.glyphs.end() ? face.glyphs.at(kMissing) : found->second;
}

TextLine FontAtlas::lay_out(std::string_view text, double x, double y) const {
  TextLine line;
  double pen = x;
  bool up = false;
  while (!text.empty()) {
    const std::uint32_t code = next_code_point(text);
    if (code == '^' && raises(text)) {
      up = true;
      continue;
    }
    if (up && code != '-' && (code < '0' || code > '9')) up = false;
    const AtlasGlyph& glyph = find(up ? raised_ : normal_, code);
    const double baseline = y - (up ? kRaisedBy * cap_height_ : 0);
    line.glyphs.push_back(
        {&glyph, static_cast<int>(std::lround(pen)) + glyph.left, static_cast<int>(std::lround(baseline)) + glyph.top});
    pen += glyph.advance;
  }
  line.width = std::max(0.0, pen - x - kLetterGap * normal_.scale);
  return line;
}

}  // namespace curlew
