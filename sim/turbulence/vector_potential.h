// Vector potential of a vorticity on a background grid: lap psi = -zeta, u = curl psi, for vorticity refinement.
//
// Particles hand V zeta to the nodes by quadratic B-splines; the seven-point Laplacian (five in 2D) is solved by
// multigrid; curl psi is the derivative of the same splines. Nodes lie 1.5 particle spacings apart: what spreading,
// collecting and the two SPH curls around it take from waves near that spacing, a sharpening of the right-hand side
// by 1 - c delta^2 along each axis gives back, so that between 6 and 32 spacings a wave returns within 0.15 of whole,
// and never with more than 1.02 (tests/scenes/vorticity_refinement.cpp). What two V-cycles leave
// unsolved is less than 0.01 of a wave.
//
// In the faces of the domain, open ones too, the flow is mirrored, as in slip walls: of psi, an axial vector, the part
// along a face is odd, the part across even, and no flow goes through. Axes may be periodic. Sums are gathered in an
// order that does not depend on the number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/fields.h"
#include "sim/core/simd.h"
#include "sim/scene/scene.h"

namespace curlew {

class VectorPotential {
 public:
  VectorPotential() = default;
  // Throws InputError where the domain is too large for its grid.
  explicit VectorPotential(const Scene& scene);

  bool empty() const { return levels_.empty(); }

  // Puts a node at this place, along periodic axes: a grid that goes with a particle gives the same answer in every
  // frame (one that stood still moved the energy of Taylor-Green vortices by 2e-4 in 0.2 s).
  void follow(Vec3 place);

  // From the vorticity (1/s) of the particles, with their volumes (m^D) in w.
  void solve(std::span<const Vec3> position, std::span<const Vec3> vorticity);

  // curl psi (m/s) at a place; 0 outside the domain.
  Vec3 curl(Vec3 position) const;

  std::size_t bytes() const;

 private:
  using Nodes = Array<Vec3>;
  static constexpr int longest_line = 8;

  // A grid with one ghost node at each end of each axis that is there.
  struct Level {
    std::array<int, 3> nodes{1, 1, 1}, ghosts{};  // nodes without ghosts; ghosts at each end
    std::array<int, 3> coarser{1, 1, 1};          // 2 where the next level has half the intervals
    Vec3 weight;                                  // 1 / h^2 along each axis, 0 along an axis that is not there
    // Lines of few nodes along an axis that is not coarsened further are solved whole; -1 where there is none. For the
    // components along the line and across it: the inverse of the Laplacian along it plus the other weights.
    int line_axis = -1;
    std::array<std::array<std::array<float, longest_line>, longest_line>, 2> line_inverse{};
    std::array<std::ptrdiff_t, 3> stride{};
    Nodes psi, source, residual;

    void allocate();
    std::ptrdiff_t at(int x, int y, int z) const {
      return (x + ghosts[0]) + (y + ghosts[1]) * stride[1] + (z + ghosts[2]) * stride[2];
    }
  };
  // Where a place lies: its nearest node, and the spline's weights and slopes (1/m) there and to both sides.
  struct Place {
    std::ptrdiff_t node;
    float weight[3][3], slope[3][3];  // [axis][-1, 0, 1]
  };

  // Coordinate along an axis in intervals from the first node.
  float along(int axis, Vec3 position) const;
  bool place(Vec3 position, Place& found) const;
  void spread(std::span<const Vec3> position, std::span<const Vec3> vorticity);
  void fold_ghosts();
  void sharpen();
  void remove_means();
  void fill_ghosts(const Level& level, Nodes& values) const;
  void prepare_lines(Level& level) const;
  void smooth(Level& level, int rounds) const;
  void smooth_lines(Level& level, int rounds) const;
  void find_residual(Level& level) const;
  void cycle(std::size_t depth);

  int dimension_ = 3;
  std::array<bool, 3> periodic_{};
  Vec3 origin_, inverse_spacing_;
  std::vector<Level> levels_;  // finest first
  std::vector<std::uint32_t> order_, plane_begin_;
};

}  // namespace curlew
