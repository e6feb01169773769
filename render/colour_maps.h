// Colour maps: from a fraction between 0 and 1 to a colour.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace curlew {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;  // sRGB
  bool operator==(const Rgb&) const = default;
};

// A map at 256 even steps. Names: water, viridis, magma, turbo, coolwarm, grey (the list for users is
// colour_map_names() in sim/scene/names.h). Throws InputError for another name.
const std::array<Rgb, 256>& colour_map(std::string_view name);

}  // namespace curlew
