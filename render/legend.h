// The colour scale with its numbers, label and unit at the right, and the simulated time at the upper left.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "render/overlay.h"
#include "sim/core/frame.h"

namespace curlew {

// "speed (m/s)"; with a power of ten "pressure (10^3 Pa)"; without a unit "density error".
std::string legend_title(const ColourField& field, int exponent);

// The part of the picture's width that is kept free for the scale. It depends on nothing else, so that a fitted camera
// stands still while the numbers change.
double legend_margin(int width, int height);

void add_colour_scale(Overlay& overlay, int width, int height, const ColourField& field, std::string_view map,
                      std::array<double, 2> range);
void add_time(Overlay& overlay, int width, int height, double seconds);

}  // namespace curlew
