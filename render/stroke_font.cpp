// The letters. A path is read by a pen: "m x y" lifts it to a point, "l x y" draws to one, "a cx cy rx ry from to"
// draws along an ellipse between two angles (degrees, anticlockwise from the right), going to its start first by a line
// unless the pen was just lifted with "u".
#include "render/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace curlew {
namespace {

struct Row {
  std::uint32_t code;
  const char* path;
};

constexpr Row kGlyphs[] = {
    {'0', "m 0 3 l 0 7 a 3 7 3 3 180 0 l 6 3 a 3 3 3 3 0 -180"},
    {'1', "m 1.2 8 l 3.6 10 l 3.6 0"},
    {'2', "a 3 7.1 2.8 2.9 170 -33 l 0 0 l 6 0"},
    {'3', "a 3 7.65 2.5 2.35 155 -90 a 3 2.65 3 2.65 90 -155"},
    {'4', "m 4.4 0 l 4.4 10 l 0 2.7 l 6.2 2.7"},
    {'5', "m 5.4 10 l 1 10 l 0.6 5.2 a 2.9 3.2 3.1 3.2 128 -150"},
    {'6', "a 3 3.1 3 3.1 0 360 u a 5.4 3.1 5.4 6.9 180 100"},
    {'7', "m 0 10 l 6 10 l 2 0"},
    {'8', "a 3 7.6 2.5 2.4 0 360 u a 3 2.6 3 2.6 0 360"},
    {'9', "a 3 6.9 3 3.1 0 360 u a 0.6 6.9 5.4 6.9 0 -80"},
    {'A', "m 0 0 l 3.4 10 l 6.8 0 m 1.1 3.2 l 5.7 3.2"},
    {'B', "m 0 0 l 0 10 l 2.9 10 a 2.9 7.6 2.5 2.4 90 -90 l 0 5.2 m 2.9 5.2 a 3.2 2.6 2.8 2.6 90 -90 l 0 0"},
    {'C', "a 3.5 5 3.5 5 48 312"},
    {'D', "m 0 0 l 0 10 l 2.3 10 a 2.3 5 4 5 90 -90 l 0 0"},
    {'E', "m 5.2 10 l 0 10 l 0 0 l 5.2 0 m 0 5.2 l 4.5 5.2"},
    {'F', "m 5.2 10 l 0 10 l 0 0 m 0 5.1 l 4.5 5.1"},
    {'G', "a 3.5 5 3.5 5 48 335 l 6.8 4.7 l 4 4.7"},
    {'H', "m 0 0 l 0 10 m 6.2 0 l 6.2 10 m 0 5.2 l 6.2 5.2"},
    {'I', "m 0 0 l 0 10"},
    {'J', "m 4.2 10 l 4.2 2.6 a 2 2.6 2.2 2.6 0 -165"},
    {'K', "m 0 0 l 0 10 m 5.8 10 l 0 4 m 2.1 6.1 l 6.2 0"},
    {'L', "m 0 10 l 0 0 l 5 0"},
    {'M', "m 0 0 l 0 10 l 3.8 3.4 l 7.6 10 l 7.6 0"},
    {'N', "m 0 0 l 0 10 l 6.2 0 l 6.2 10"},
    {'O', "a 3.6 5 3.6 5 0 360"},
    {'P', "m 0 0 l 0 10 l 3 10 a 3 7.2 2.8 2.8 90 -90 l 0 4.4"},
    {'Q', "a 3.6 5 3.6 5 0 360 m 4.4 2.6 l 7 -0.6"},
    {'R', "m 0 0 l 0 10 l 3 10 a 3 7.2 2.8 2.8 90 -90 l 0 4.4 m 3 4.4 l 5.9 0"},
    {'S', "a 3 7.55 2.7 2.45 32 270 a 3 2.55 2.9 2.55 90 -152"},
    {'T', "m 0 10 l 6.4 10 m 3.2 10 l 3.2 0"},
    {'U', "m 0 10 l 0 3.1 a 3.1 3.1 3.1 3.1 180 360 l 6.2 10"},
    {'V', "m 0 10 l 3.3 0 l 6.6 10"},
    {'W', "m 0 10 l 2.3 0 l 4.7 10 l 7.1 0 l 9.4 10"},
    {'X', "m 0 10 l 6.2 0 m 6.2 10 l 0 0"},
    {'Y', "m 0 10 l 3.2 4.6 l 6.4 10 m 3.2 4.6 l 3.2 0"},
    {'Z', "m 0 10 l 6 10 l 0 0 l 6.2 0"},
    {'a', "a 2.6 3.5 2.6 3.5 0 360 m 5.2 7 l 5.2 0"},
    {'b', "m 0 10 l 0 0 u a 2.6 3.5 2.6 3.5 0 360"},
    {'c', "a 2.7 3.5 2.7 3.5 52 308"},
    {'d', "a 2.6 3.5 2.6 3.5 0 360 m 5.2 10 l 5.2 0"},
    {'e', "m 0 3.5 l 5.3 3.5 a 2.65 3.5 2.65 3.5 0 312"},
    {'f', "a 3.4 8 2 2 78 180 l 1.4 0 m 0 6.8 l 3.5 6.8"},
    {'g', "a 2.6 3.5 2.6 3.5 0 360 m 5.2 7 l 5.2 -0.4 a 2.7 -0.4 2.5 2.7 0 -155"},
    {'h', "m 0 10 l 0 0 m 0 4.4 a 2.5 4.4 2.5 2.6 180 0 l 5 0"},
    {'i', "m 0 7 l 0 0 u a 0 9.6 0.15 0.15 0 360"},
    {'j', "m 1.5 7 l 1.5 -1.2 a -0.2 -1.2 1.7 1.9 0 -90 u a 1.5 9.6 0.15 0.15 0 360"},
    {'k', "m 0 10 l 0 0 m 4.5 7 l 0 2.7 m 1.7 4.3 l 4.9 0"},
    {'l', "m 0 10 l 0 0"},
    {'m', "m 0 7 l 0 0 m 0 4.8 a 2.1 4.8 2.1 2.2 180 0 l 4.2 0 m 4.2 4.8 a 6.3 4.8 2.1 2.2 180 0 l 8.4 0"},
    {'n', "m 0 7 l 0 0 m 0 4.4 a 2.5 4.4 2.5 2.6 180 0 l 5 0"},
    {'o', "a 2.7 3.5 2.7 3.5 0 360"},
    {'p', "m 0 7 l 0 -3 u a 2.6 3.5 2.6 3.5 0 360"},
    {'q', "a 2.6 3.5 2.6 3.5 0 360 m 5.2 7 l 5.2 -3"},
    {'r', "m 0 7 l 0 0 m 0 4.2 a 2.6 4.2 2.6 2.8 180 78"},
    {'s', "a 2.3 5.2 2.1 1.8 30 270 a 2.3 1.7 2.3 1.7 90 -152"},
    {'t', "m 1.4 9.3 l 1.4 1.9 a 3.2 1.9 1.8 1.9 180 280 m 0 6.8 l 3.5 6.8"},
    {'u', "m 0 7 l 0 2.6 a 2.5 2.6 2.5 2.6 180 360 m 5 7 l 5 0"},
    {'v', "m 0 7 l 2.5 0 l 5 7"},
    {'w', "m 0 7 l 1.9 0 l 3.8 7 l 5.7 0 l 7.6 7"},
    {'x', "m 0 7 l 4.7 0 m 4.7 7 l 0 0"},
    {'y', "m 0 7 l 2.5 0 m 5 7 l 1.5 -3"},
    {'z', "m 0.1 7 l 4.6 7 l 0 0 l 4.8 0"},
    {'.', "a 0.2 0.2 0.2 0.2 0 360"},
    {',', "m 0.7 0.3 l 0.1 -1.8"},
    {':', "a 0.2 0.2 0.2 0.2 0 360 u a 0.2 6 0.2 0.2 0 360"},
    {';', "m 0.7 0.3 l 0.1 -1.8 u a 0.6 6 0.2 0.2 0 360"},
    {'!', "m 0.2 10 l 0.2 3 u a 0.2 0.2 0.2 0.2 0 360"},
    {'?', "a 2.5 7.4 2.5 2.6 165 -70 l 2.6 3 u a 2.6 0.2 0.2 0.2 0 360"},
    {'-', "m 0 4.4 l 3.6 4.4"},
    {'+', "m 0 4.4 l 5.4 4.4 m 2.7 1.7 l 2.7 7.1"},
    {'=', "m 0 5.9 l 5.4 5.9 m 0 3 l 5.4 3"},
    {'/', "m 0 -1.4 l 4.2 11"},
    {'\\', "m 0 11 l 4.2 -1.4"},
    {'|', "m 0 -2 l 0 11"},
    {'(', "a 5.2 4.6 5.2 7.8 125 235"},
    {')', "a -2.98 4.6 5.2 7.8 -55 55"},
    {'[', "m 2 11 l 0 11 l 0 -2 l 2 -2"},
    {']', "m 0 11 l 2 11 l 2 -2 l 0 -2"},
    {'<', "m 5 7.6 l 0 4.4 l 5 1.2"},
    {'>', "m 0 7.6 l 5 4.4 l 0 1.2"},
    {'_', "m 0 -1 l 5.6 -1"},
    {'^', "m 0 6.6 l 2.3 10 l 4.6 6.6"},
    {'*', "m 2.2 10 l 2.2 5.4 m 0.2 8.85 l 4.2 6.55 m 4.2 8.85 l 0.2 6.55"},
    {'\'', "m 0 10 l 0 7.4"},
    {'"', "m 0 10 l 0 7.4 m 2.2 10 l 2.2 7.4"},
    {'%', "a 1.8 7.9 1.8 2.1 0 360 u a 6.6 2.1 1.8 2.1 0 360 m 6.8 10 l 1.6 0"},
    {'#', "m 1.7 0 l 2.7 10 m 4.3 0 l 5.3 10 m 0.2 3.4 l 6.3 3.4 m 0.7 6.6 l 6.8 6.6"},
    {'&', "m 6.6 0 l 1.6 6.6 a 2.7 7.9 1.6 2.1 218 -40 l 1 4.6 a 2.6 2.5 2.6 2.5 140 330 l 6.4 4.6"},
    {'~', "a 1.4 4.2 1.4 1.3 180 30 l 3.9 3.6 a 5 4.4 1.4 1.3 210 360"},
    {0xb0, "a 1.6 8.4 1.6 1.6 0 360"},                                     // degree
    {0xb7, "a 0.2 4.4 0.2 0.2 0 360"},                                     // middle dot
    {0xd7, "m 0 7 l 4.4 2.6 m 4.4 7 l 0 2.6"},                             // times
    {0xb5, "m 0 7 l 0 -3 m 0 2.6 a 2.5 2.6 2.5 2.6 180 360 m 5 7 l 5 0"},  // micro
    {0x3bc, "m 0 7 l 0 -3 m 0 2.6 a 2.5 2.6 2.5 2.6 180 360 m 5 7 l 5 0"},
    {0x3c9, "a 2.1 2.5 2.1 2.5 110 360 l 4.2 4.4 m 4.2 4.4 l 4.2 2.5 a 6.3 2.5 2.1 2.5 180 430"},  // omega
    {0x2212, "m 0 4.4 l 5.4 4.4"},                                                                 // minus
};

constexpr const char* kMissing = "m 0 0 l 0 10 l 5 10 l 5 0 l 0 0";

StrokeGlyph read_path(const char* path) {
  StrokeGlyph glyph;
  std::istringstream in(path);
  bool lifted = true;
  const auto to = [&](double x, double y) {
    if (lifted) glyph.strokes.emplace_back();
    lifted = false;
    glyph.strokes.back().push_back({x, y});
    glyph.width = std::max(glyph.width, x);
  };
  for (std::string command; in >> command;) {
    if (command == "u") lifted = true;
    if (command == "m" || command == "l") {
      double x = 0, y = 0;
      in >> x >> y;
      lifted = lifted || command == "m";
      to(x, y);
    } else if (command == "a") {
      double cx = 0, cy = 0, rx = 0, ry = 0, from = 0, until = 0;
      in >> cx >> cy >> rx >> ry >> from >> until;
      const int steps = std::max(2, static_cast<int>(std::ceil(std::abs(until - from) / 9)));
      for (int i = 0; i <= steps; ++i) {
        const double angle = (from + (until - from) * i / steps) * std::numbers::pi / 180;
        to(cx + rx * std::cos(angle), cy + ry * std::sin(angle));
      }
    }
  }
  return glyph;
}

}  // namespace

StrokeGlyph stroke_glyph(std::uint32_t code_point) {
  if (code_point == ' ') return {1.4, {}};
  for (const Row& row : kGlyphs) {
    if (row.code != code_point) continue;
    StrokeGlyph glyph = read_path(row.path);
    if (code_point >= '0' && code_point <= '9') glyph.width = 6;  // figures under figures, and no dancing clock
    return glyph;
  }
  return read_path(kMissing);
}

}  // namespace curlew
