#include "render/colour_range.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace curlew {

std::array<double, 2> colour_range(const Frame& frame) {
  std::vector<float> values;
  values.reserve(frame.value.size());
  std::copy_if(frame.value.begin(), frame.value.end(), std::back_inserter(values),
               [](float v) { return std::isfinite(v); });
  if (values.empty()) return {0, 1};
  const auto at = [&](double fraction) {
    const auto i = static_cast<std::ptrdiff_t>(std::lround(fraction * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + i, values.end());
    return static_cast<double>(values[static_cast<std::size_t>(i)]);
  };
  double low = at(0.001), high = at(0.999);
  if (low < 0 && high > 0) {
    high = std::max(-low, high);
    low = -high;
  } else if (low >= 0 && low < 0.5 * high) {
    low = 0;
  }
  if (!(high - low > 1e-6 * std::max(std::abs(low), std::abs(high)))) high = low + std::max(1e-3, 0.01 * std::abs(low));
  return {low, high};
}

std::array<double, 2> united(std::array<double, 2> a, std::array<double, 2> b) {
  return {std::min(a[0], b[0]), std::max(a[1], b[1])};
}

}  // namespace curlew
