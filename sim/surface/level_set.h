// The level set whose zero is the water's surface, on bricks of 8 x 8 x 8 points of which only those near the surface
// hold anything:
//   phi(x) = sum_j w_j (1 - |M_j (x - x_j)|^2)^3 - iso,
// over the sources j that reach x: particles, or what stands for them. Positive inside. M_j is 1/R for a round source;
// an ellipsoid has a matrix of its own (Yu & Turk 2013).
//
// At walls the water is mirrored and at periodic faces it goes on, and then phi is cut off at the domain's face: the
// surface is flat there, and closed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/fields.h"
#include "sim/scene/scene.h"
#include "sim/sph/candidates.h"
#include "sim/sph/grid.h"
#include "sim/surface/images.h"

namespace curlew {

// How far a source reaches and in which directions: |M x|^2 = diagonal . (x^2, y^2, z^2) + 2 mixed . (yz, zx, xy).
struct SourceShape {
  Vec3 diagonal, mixed;  // 1/m^2
  Vec3 reach;            // m along each axis: beyond it the source adds nothing
};

SourceShape round_shape(double radius);

// What the level set is made from. The arrays stay the caller's.
struct SurfaceSources {
  std::span<const Vec3> position;      // m; w: the source's w_j
  std::span<const SourceShape> shape;  // one a source, or one for all, or those that `kind` counts, all round
  std::span<const std::uint8_t> kind;  // number of each source's shape; where it is not 0, the source is part of a
                                       // particle and does not count when full water is looked for
  double spacing = 0;                  // m: where the water is full, a source stands for a cube of this side
};

class LevelSet {
 public:
  static constexpr int side = 8;  // points of a brick along each axis
  static constexpr int points = side * side * side;

  // Which points of a brick are inside: word x, bit 8 y + z.
  using Bits = std::array<std::uint64_t, side>;

  struct Brick {
    std::array<int, 3> at{};              // its first point is side * at
    std::array<std::int32_t, 27> near{};  // bricks around it, 9 x + 3 y + z with 0, 1, 2 for before, here, after; or -1
    bool full = false;                    // deep in the water: not summed, phi is that of full water

    std::int32_t beside(int dx, int dy, int dz) const {
      return near[static_cast<std::size_t>(9 * (dx + 1) + 3 * (dy + 1) + dz + 1)];
    }
  };

  // `cell` in m, at least an eighth of the widest source's reach; iso as a share of full water, 0 to 1.
  void build(const SurfaceSources& sources, const Domain& domain, double cell, double iso);

  std::span<const Brick> bricks() const { return bricks_; }
  // Values at a brick's points, number 64 x + 8 y + z.
  const float* values(std::size_t brick) const { return &values_[brick * points]; }
  const Bits& inside(std::size_t brick) const { return inside_[brick]; }
  float value_outside() const { return -iso_; }  // beyond all bricks

  // Points lie at low + (g - 1/2) cell for whole g. Cells are as wide as asked for or a little less: a whole number of
  // them fits into the domain, whose faces lie midway between points.
  Vec3d cell() const { return cell_; }
  Vec3 place(const Brick& brick, float x, float y, float z) const {
    const auto along = [&](int axis, float p) {
      return static_cast<float>(low_[axis] + (side * brick.at[static_cast<std::size_t>(axis)] - 0.5) * cell_[axis]) +
             p * static_cast<float>(cell_[axis]);
    };
    return {along(0, x), along(1, y), along(2, z)};
  }

  // Working memory of a search, one a thread.
  struct Searcher {
    Candidates near;
    Grid::Hints hints;
    std::vector<std::uint32_t> found;
  };
  // The sources that reach a brick, images included, as numbers for position_of and the like; valid until the next
  // call.
  std::span<const std::uint32_t> find_sources(const Brick& brick, Searcher& searcher) const;
  Vec3 position_of(std::uint32_t found) const { return position_[found]; }                // w: the source's w_j
  std::uint32_t number_of(std::uint32_t found) const { return origin_[found].number(); }  // in the caller's arrays
  // A vector of that source, mirrored as the image is.
  Vec3 mirrored(Vec3 vector, std::uint32_t found) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (origin_[found].is_mirrored(axis)) vector[axis] = -vector[axis];
    }
    return vector;
  }
  Vec3 reach() const { return reach_; }  // of the widest source, m

  std::size_t bytes() const;

 private:
  struct Occupied;  // what is known of a brick that holds sources
  struct Local;     // a source as its brick sees it

  void lay_out(const Domain& domain, double cell);
  void collect_sources(const SurfaceSources& sources, const Domain& domain);
  void find_bricks(const SurfaceSources& sources);
  void link_bricks(const std::vector<Occupied>& occupied);
  void sum_sources(const SurfaceSources& sources);
  void cut_off(std::size_t brick);

  Vec3d low_, cell_;
  std::array<int, 3> cells_{};                  // of the domain along each axis
  std::array<bool, 3> cut_low_{}, cut_high_{};  // faces of the domain at which phi is cut off
  float iso_ = 0.5f;
  Vec3 reach_;  // of the widest source, m

  std::vector<Vec3> unsorted_, position_;  // sources and their images
  std::vector<ImageOrigin> unsorted_origin_, origin_;
  std::vector<std::uint32_t> order_;
  CellShape brick_shape_;
  Grid grid_;  // of the sources, one cell a brick

  std::vector<std::uint64_t> keys_;  // of the bricks, rising
  std::vector<Brick> bricks_;
  Array<float> values_;
  std::vector<Bits> inside_;
};

}  // namespace curlew
