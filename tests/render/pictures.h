// What the tests of pictures share: small frames and a way to look at pixels.
#pragma once

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "render/image.h"
#include "render/renderer.h"
#include "sim/core/frame.h"

namespace curlew::test {

// An empty box, with particles at the given places.
inline Frame frame_of(std::vector<Vec3> positions, double radius, int dimension = 3) {
  auto geometry = std::make_shared<FrameGeometry>();
  geometry->dimension = dimension;
  geometry->particle_radius = radius;
  geometry->domain.min = {-1, -1, dimension == 3 ? -1.0 : 0.0};
  geometry->domain.max = {1, 1, dimension == 3 ? 1.0 : 0.0};
  Frame frame;
  frame.position = std::move(positions);
  frame.geometry = geometry;
  return frame;
}

// A lattice of water with a slope, coloured by height.
inline Frame slope_of_water(int dimension = 3) {
  std::vector<Vec3> positions;
  const float step = 0.1f;
  for (float x = -0.95f; x < 1; x += step)
    for (float y = -0.95f; y < -0.5f * x; y += step)
      for (float z = dimension == 3 ? -0.95f : 0.f; z < (dimension == 3 ? 1.f : 0.01f); z += step)
        positions.push_back({x, y, z});
  Frame frame = frame_of(positions, 0.5 * static_cast<double>(step), dimension);
  for (const Vec3& p : frame.position) frame.value.push_back(p.y + 1);
  frame.colour = {"height", "height", "m"};
  return frame;
}

// Nothing but particles, drawn in their true size.
inline ViewSettings bare_view() {
  ViewSettings settings;
  settings.look.show_walls = settings.look.show_legend = settings.look.show_floor = false;
  settings.particle_scale = 1.0;
  return settings;
}

inline int difference(const std::uint8_t* a, const std::uint8_t* b) {
  int largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(int(a[i]) - int(b[i])));
  return largest;
}

// Pixels that differ by more than `tolerance` in any channel.
inline int differing_pixels(const Image& a, const Image& b, int tolerance = 0) {
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) count += difference(a.at(x, y), b.at(x, y)) > tolerance;
  return count;
}

}  // namespace curlew::test
