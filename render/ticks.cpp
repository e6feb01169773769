#include "render/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace curlew {
namespace {

// The smallest of 1, 2, 5, 10, ... times a power of ten that is at least `step`.
double rounded_up(double step) {
  const double power = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

int count_inside(std::array<double, 2> range, double step) {
  return static_cast<int>(std::floor(range[1] / step + 1e-6) - std::ceil(range[0] / step - 1e-6)) + 1;
}

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

}  // namespace

Ticks round_ticks(std::array<double, 2> range, int most) {
  Ticks ticks;
  const double span = range[1] - range[0];
  if (!std::isfinite(span) || !(span > 0)) return ticks;
  double step = rounded_up(span / std::max(most, 2));
  while (count_inside(range, step) > std::max(most, 2)) step = rounded_up(1.5 * step);

  const double largest = std::max(std::abs(range[0]), std::abs(range[1]));
  if (largest >= 1e4 || largest < 1e-2) ticks.exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
  const double unit = std::pow(10, ticks.exponent);
  const int decimals = std::clamp(-static_cast<int>(std::floor(std::log10(step / unit) + 1e-9)), 0, 9);
  const double first = std::ceil(range[0] / step - 1e-6);
  for (int i = 0; i < count_inside(range, step); ++i) {
    const double value = (first + i) * step;
    ticks.at.push_back(value);
    ticks.text.push_back(number(value == 0 ? 0.0 : value / unit, decimals));
  }
  return ticks;
}

}  // namespace curlew
