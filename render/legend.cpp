#include "render/legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/colour_maps.h"
#include "render/ticks.h"

namespace curlew {
namespace {

// Everything grows with the picture, but letters stay readable on a small one.
int cap_height_of(int width, int height) {
  return std::max(7, static_cast<int>(std::lround(std::min(height / 66.0, width / 100.0))));
}

Ink ink_of(Rgb c) {
  return {static_cast<float>(c.r) / 255.f, static_cast<float>(c.g) / 255.f, static_cast<float>(c.b) / 255.f, 1};
}

void add_frame(Overlay& overlay, double left, double top, double right, double bottom, double line) {
  const Ink ink = overlay.ink();
  overlay.bar(left - line, top - line, right + line, top, ink, ink);
  overlay.bar(left - line, bottom, right + line, bottom + line, ink, ink);
  overlay.bar(left - line, top, left, bottom, ink, ink);
  overlay.bar(right, top, right + line, bottom, ink, ink);
}

}  // namespace

double legend_margin(int width, int height) { return 10.0 * cap_height_of(width, height) / width; }

std::string legend_title(const ColourField& field, int exponent) {
  std::string unit;
  if (exponent != 0) unit.append("10^").append(std::to_string(exponent));
  if (!field.unit.empty() && field.unit != "1") unit.append(unit.empty() ? "" : " ").append(field.unit);
  std::string title(field.label);
  if (!unit.empty()) title.append(" (").append(unit).append(")");
  return title;
}

void add_colour_scale(Overlay& overlay, int width, int height, const ColourField& field, std::string_view map,
                      std::array<double, 2> range) {
  const int cap = cap_height_of(width, height);
  const FontAtlas& font = overlay.font(cap);
  const double length = std::round(0.40 * height), top = std::round(0.5 * (height - length)), bottom = top + length;
  const Ticks ticks = round_ticks(range, std::clamp(static_cast<int>(length / (3.0 * cap)), 2, 7));

  double numbers = 0;
  for (const std::string& text : ticks.text) numbers = std::max(numbers, font.width_of(text));
  const double thickness = std::round(1.5 * cap), line = std::max(1.0, std::round(cap / 11.0));
  const double right_edge = std::round(width - 2.0 * cap - numbers), gap = std::round(0.9 * cap);
  const double bar_right = right_edge - gap, bar_left = bar_right - thickness;

  const auto& colours = colour_map(map);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double cells = static_cast<double>(colours.size()), k = static_cast<double>(i);
    const Ink ink = ink_of(colours[i]);
    overlay.bar(bar_left, bottom - length * (k + 1) / cells, bar_right, bottom - length * k / cells, ink, ink);
  }
  add_frame(overlay, bar_left, top, bar_right, bottom, line);

  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    const double y = std::round(bottom - length * (ticks.at[i] - range[0]) / (range[1] - range[0]));
    overlay.bar(bar_right + line, y - 0.5 * line, bar_right + line + std::round(0.35 * cap), y + 0.5 * line,
                overlay.ink(), overlay.ink());
    overlay.text(cap, ticks.text[i], right_edge + numbers - font.width_of(ticks.text[i]), y + std::floor(0.5 * cap));
  }

  const std::string title = legend_title(field, ticks.exponent);
  overlay.text(cap, title, std::max(1.0 * cap, width - 2.0 * cap - font.width_of(title)), top - 1.5 * cap);
}

void add_time(Overlay& overlay, int width, int height, double seconds) {
  const int cap = cap_height_of(width, height);
  char text[64];
  std::snprintf(text, sizeof text, "t = %.3f s", seconds);
  overlay.text(cap, text, 2.0 * cap, 2.4 * cap);
}

}  // namespace curlew
