#include "sim/surface/images.h"

namespace curlew {

bool is_cut_off(const Domain& domain, int axis, int side) {
  return domain.periodic[static_cast<std::size_t>(axis)] ||
         domain.walls[static_cast<std::size_t>(2 * axis + side)].kind != WallKind::open;
}

void collect_images(std::span<const Vec3> particles, const Domain& domain, Vec3 reach, std::vector<Vec3>& position,
                    std::vector<ImageOrigin>& origin) {
  position.assign(particles.begin(), particles.end());
  origin.resize(particles.size());
  for (std::size_t i = 0; i < origin.size(); ++i) origin[i] = ImageOrigin(static_cast<std::uint32_t>(i));
  // Axis by axis, so that images get images of their own at edges and corners.
  for (int axis = 0; axis < 3; ++axis) {
    const bool periodic = domain.periodic[static_cast<std::size_t>(axis)];
    const bool at_low = is_cut_off(domain, axis, 0), at_high = is_cut_off(domain, axis, 1);
    const auto low = static_cast<float>(domain.min[axis]), high = static_cast<float>(domain.max[axis]);
    const std::size_t so_far = position.size();
    for (std::size_t i = 0; i < so_far; ++i) {
      const float x = position[i][axis];
      const auto add = [&](float image) {
        Vec3 p = position[i];
        p[axis] = image;
        position.push_back(p);
        origin.push_back(periodic ? origin[i] : origin[i].mirrored(axis));
      };
      if (at_low && x - low < reach[axis] && x >= low) add(periodic ? x + (high - low) : low - (x - low));
      if (at_high && high - x < reach[axis] && x <= high) add(periodic ? x - (high - low) : high + (high - x));
    }
  }
}

}  // namespace curlew
