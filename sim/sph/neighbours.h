// Neighbour lists, built once a step and read by every sweep: for each particle the numbers of those nearer than the
// support, itself left out, rising, in groups of eight. A last group that is not full repeats the particle itself,
// which adds exactly nothing to any sum over x_ij, grad W_ij or a difference A_ij.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/fields.h"
#include "sim/core/simd.h"
#include "sim/sph/grid.h"

namespace curlew {

class NeighbourLists {
 public:
  void build(const CellShape& shape, const Grid& grid, std::span<const Vec3> position, double support);

  std::uint32_t count(std::size_t i) const { return count_[i]; }
  // Groups of eight numbers; the last may be padded.
  const std::uint32_t* begin(std::size_t i) const { return entries_.data() + std::size_t{first_group_[i]} * 8; }
  std::size_t groups(std::size_t i) const { return (count_[i] + 7u) / 8u; }

  std::uint64_t pairs() const { return pairs_; }
  std::size_t bytes() const;

 private:
  Array<std::uint32_t> entries_;
  std::vector<std::uint32_t> first_group_;
  std::vector<std::uint32_t> count_;
  std::uint64_t pairs_ = 0;
};

// The shortest image of a difference of positions. `Open` leaves it alone; `Wrapped` knows the periods.
struct Open {
  void operator()(f8&, f8&, f8&) const {}
};
class Wrapped {
 public:
  explicit Wrapped(const CellShape& shape) {
    for (int axis = 0; axis < 3; ++axis) {
      period_[axis] = shape.period[axis];
      inverse_[axis] = shape.period[axis] > 0 ? 1 / shape.period[axis] : 0;
    }
  }
  void operator()(f8& x, f8& y, f8& z) const {
    x -= period_[0] * nearest(x * inverse_[0]);
    y -= period_[1] * nearest(y * inverse_[1]);
    z -= period_[2] * nearest(z * inverse_[2]);
  }

 private:
  float period_[3], inverse_[3];
};

// Calls f(Open) or f(Wrapped), so that only periodic scenes pay for images.
template <class F>
void with_images(const CellShape& shape, F&& f) {
  if (shape.periodic())
    f(Wrapped(shape));
  else
    f(Open());
}

// Eight pairs (i, j): x_ij = x_i - x_j, its square, the fourth number of x_j, and the numbers j.
struct Pairs {
  f8 x, y, z, w, r2;
  const std::uint32_t* j;
};

// Calls body(pairs) for each group of neighbours of particle i at `position`.
template <class Images, class Body>
inline void for_pairs(const NeighbourLists& lists, const Vec3* position, std::size_t i, const Images& images,
                      Body&& body) {
  const Vec3 here = position[i];
  const std::uint32_t* j = lists.begin(i);
  for (std::size_t g = lists.groups(i); g > 0; --g, j += 8) {
    const Vec8 there = gather(position, j);
    Pairs p{here.x - there.x, here.y - there.y, here.z - there.z, there.w, {}, j};
    images(p.x, p.y, p.z);
    p.r2 = p.x * p.x + p.y * p.y + p.z * p.z;
    body(p);
  }
}

}  // namespace curlew
