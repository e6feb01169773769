// Round numbers along a scale.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace curlew {

struct Ticks {
  std::vector<double> at;         // in the scale's own unit
  std::vector<std::string> text;  // of at / 10^exponent
  int exponent = 0;               // a multiple of three, 0 where plain numbers are short enough
};

// Steps of 1, 2 or 5 times a power of ten, at most `most` ticks (at least 2), all inside range. Throws nothing: a range
// that is empty or not finite has no ticks.
Ticks round_ticks(std::array<double, 2> range, int most);

}  // namespace curlew
