#include "render/in_sight.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace curlew {
namespace {

constexpr int kMostLayers = 4;
constexpr float kNothing = std::numeric_limits<float>::max();

// The picture in tiles, one more on every side; each knows how far its nearest particles are.
struct Tiles {
  int across, up;
  float wide;  // at distance 1, or in metres (orthographic)
  float half_width, half_height;
  std::vector<std::array<float, kMostLayers>> nearest;

  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(across) + static_cast<std::size_t>(i);
  }
  std::size_t index(float x, float y) const {
    return at(1 + static_cast<int>((x + half_width) / wide), 1 + static_cast<int>((y + half_height) / wide));
  }
};

// As narrow as a particle is at `farthest`: nearer ones cover their tile all the better.
Tiles tiles_of(const View& view, double spacing, double farthest) {
  Tiles tiles;
  const double wide = view.orthographic ? spacing : spacing / farthest;
  const double width = view.half_height * view.aspect + wide, height = view.half_height + wide;
  // A stray particle far away must not make them countless.
  const double enough = std::max(wide, std::sqrt(4 * width * height / 4e5));
  tiles.wide = static_cast<float>(enough);
  tiles.half_width = static_cast<float>(width);
  tiles.half_height = static_cast<float>(height);
  tiles.across = static_cast<int>(2 * width / enough) + 3;
  tiles.up = static_cast<int>(2 * height / enough) + 3;
  std::array<float, kMostLayers> none;
  none.fill(kNothing);
  tiles.nearest.assign(tiles.at(0, tiles.up), none);
  return tiles;
}

}  // namespace

std::vector<std::uint32_t> in_sight(std::span<const Vec3> positions, const View& view, double spacing, int layers) {
  assert(layers >= 1 && layers <= kMostLayers);
  const Vec3 eye = to_float(view.position), right = to_float(view.right), up = to_float(view.up),
             forward = to_float(view.forward);
  struct Seen {
    std::uint32_t particle;
    float x, y, distance;
  };
  std::vector<Seen> seen;
  seen.reserve(positions.size());
  const auto d = static_cast<float>(spacing);
  const auto half_width = static_cast<float>(view.half_height * view.aspect),
             half_height = static_cast<float>(view.half_height);
  float farthest = d;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 p = positions[i] - eye;
    const float distance = dot(p, forward), scale = view.orthographic ? 1 : 1 / distance;
    const float x = scale * dot(p, right), y = scale * dot(p, up), margin = scale * d;
    if (!(distance > 0) || !(std::abs(x) < half_width + margin) || !(std::abs(y) < half_height + margin)) continue;
    seen.push_back({static_cast<std::uint32_t>(i), x, y, distance});
    farthest = std::max(farthest, distance);
  }

  Tiles tiles = tiles_of(view, spacing, static_cast<double>(farthest));
  const auto clamped = [&](const Seen& s) {
    return tiles.index(std::clamp(s.x, -tiles.half_width, tiles.half_width),
                       std::clamp(s.y, -tiles.half_height, tiles.half_height));
  };
  for (const Seen& s : seen) {
    if (positions[s.particle].w < 0.9f) continue;
    float distance = s.distance;
    for (float& nearest : tiles.nearest[clamped(s)]) {
      if (distance < nearest) std::swap(distance, nearest);
    }
  }

  // How far one can see in each tile: as far as in the most open one around it.
  std::vector<float> sight(tiles.nearest.size(), kNothing);
  const auto layer = static_cast<std::size_t>(layers - 1);
  for (int j = 1; j + 1 < tiles.up; ++j) {
    for (int i = 1; i + 1 < tiles.across; ++i) {
      float most = 0;
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) most = std::max(most, tiles.nearest[tiles.at(i + x, j + y)][layer]);
      sight[tiles.at(i, j)] = most;
    }
  }
  std::vector<std::uint32_t> kept;
  for (const Seen& s : seen) {
    if (s.distance <= sight[clamped(s)] + 0.5f * d) kept.push_back(s.particle);
  }
  return kept;
}

}  // namespace curlew
