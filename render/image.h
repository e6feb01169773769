// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace curlew {

// Rows run top to bottom, pixels left to right, four bytes each: red, green, blue (sRGB), alpha.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  // First of the four bytes of a pixel; the top left pixel is (0, 0).
  std::uint8_t* at(int x, int y) { return rgba.data() + offset(x, y); }
  const std::uint8_t* at(int x, int y) const { return rgba.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

}  // namespace curlew
