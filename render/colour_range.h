// The span of a colour scale where the scene does not give one.
#pragma once

#include <array>

#include "sim/core/frame.h"

namespace curlew {

// What the frame's values span, leaving out the outermost thousandth at each end (one wild particle must not turn all
// others into one colour). From zero where the values are positive and zero is near; symmetric where they have both
// signs. Never empty.
std::array<double, 2> colour_range(const Frame& frame);

// The widest of two ranges: a run that goes on may widen its scale, but a narrowing scale would flicker.
std::array<double, 2> united(std::array<double, 2> a, std::array<double, 2> b);

}  // namespace curlew
