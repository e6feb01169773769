// What stands beyond the faces of the domain at which water ends: particles mirrored at walls, and moved on at periodic
// faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/vec.h"
#include "sim/scene/scene.h"

namespace curlew {

// Whether water ends at a face of the domain: side 0 is the low one.
bool is_cut_off(const Domain& domain, int axis, int side);

// Which particle a point is, or whose image, and along which axes it is mirrored.
class ImageOrigin {
 public:
  constexpr explicit ImageOrigin(std::uint32_t number = 0) : bits_(number) {}
  std::uint32_t number() const { return bits_ & number_mask; }
  bool is_mirrored(int axis) const { return (bits_ >> (mirror_shift + axis) & 1u) != 0; }
  ImageOrigin mirrored(int axis) const { return ImageOrigin(bits_ ^ 1u << (mirror_shift + axis)); }

 private:
  static constexpr int mirror_shift = 29;
  static constexpr std::uint32_t number_mask = (1u << mirror_shift) - 1;
  std::uint32_t bits_;
};

// Fills in the particles, in their order, and after them the images that lie within `reach` (m along each axis) of the
// domain.
void collect_images(std::span<const Vec3> particles, const Domain& domain, Vec3 reach, std::vector<Vec3>& position,
                    std::vector<ImageOrigin>& origin);

}  // namespace curlew
