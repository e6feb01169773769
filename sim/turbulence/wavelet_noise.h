// Wavelet noise (Cook & DeRose 2005, "Wavelet Noise", ACM TOG 24(3)) and the turbulence made of its curl: Kim, Thuerey,
// James & Gross 2008, "Wavelet Turbulence for Fluid Simulation"; Fujisawa et al. 2011, Eq. 8.
//
// Three tiles N1, N2, N3 of random numbers hold only what the next coarser grid cannot: waves 2 to 4 cells long, so
// that octaves of them add up to a spectrum of one's choice. Of N_c^2, 0.84 lie at wavenumbers between 1/4 and 1/2 per
// cell (the largest of the three axes), 0.07 between 1/8 and 1/4, 0.09 above and 2e-5 below. Between the numbers
// quadratic B-splines make the noise smooth, and
//
//   w = curl (N1, N2, N3),   y(p) = sum_o w(2^o p + offset_o) 2^(-5/6 o)
//
// have no divergence: in div curl each mixed second derivative appears twice, with both signs, and the derivatives of a
// product of splines can be taken in any order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sim/core/fields.h"
#include "sim/core/vec.h"

namespace curlew {

// The filters of the paper's appendix. Analysis: coefficient i of the coarse grid is sum_k a[k + 16] r[2 i + k] with k
// from -16 to 15, r those of the fine grid. Refinement of the quadratic B-spline: B(x) = sum_k p[k] B(2 x - k).
inline constexpr std::array<double, 32> wavelet_analysis{
    0.000334,  -0.001528, 0.000410,  0.003545,  -0.000938, -0.008233, 0.002172,  0.019120,   //
    -0.005040, -0.044412, 0.011655,  0.103311,  -0.025936, -0.243780, 0.033979,  0.655340,   //
    0.655340,  0.033979,  -0.243780, -0.025936, 0.103311,  0.011655,  -0.044412, -0.005040,  //
    0.019120,  0.002172,  -0.008233, -0.000938, 0.003546,  0.000410,  -0.001528, 0.000334};
inline constexpr std::array<double, 4> wavelet_refinement{0.25, 0.75, 0.75, 0.25};

// Means over all places and seeds of N_c^2 and of w_c^2, for each c. At one place they depend on where it lies in its
// pair of cells: N_c^2 from 0.11 to 0.28, w_c^2 from 0.54 to 1.62.
inline constexpr double wavelet_noise_variance = 0.1956, wavelet_curl_variance = 1.015;

class WaveletNoise {
 public:
  static constexpr int smallest = 32, largest = 256;

  WaveletNoise() = default;  // without tiles: only empty(), size() and bytes() may be asked
  // Tiles of size^3 numbers each, the same bytes for the same seed with every compiler, instruction set and number of
  // threads. On one core (3.6 GHz EPYC) 3 ms for 32, 45 ms for 64, 0.4 s for 128; meanwhile twice bytes() more are
  // used. Throws InputError unless size is 32, 64, 128 or 256.
  WaveletNoise(int size, std::uint64_t seed);

  bool empty() const { return tile_.empty(); }
  int size() const { return size_; }
  std::size_t bytes() const { return tile_.capacity() * sizeof(Vec3); }

  // (N1, N2, N3) at the place p, in cells. Like curl() and turbulence() it repeats itself after `size` cells along each
  // axis, is exact to 1e-6 of a cell for |p| below 1e9, and NaN where p is not finite.
  Vec3 value(Vec3d p) const;

  // w(p) = curl (N1, N2, N3), in 1 / cell: derivatives of the splines, no differences.
  Vec3 curl(Vec3d p) const;

  // y(p) with offset.size() octaves (Fujisawa Eq. 8): p in cells of the coarsest one, offset[o] in cells of octave o.
  // Octave o is differentiated in its own cells, without the 2^o of d/dp, so that its energy is 2^(-5/3 o) of the
  // coarsest one's. Offsets let the noise drift; they should differ, or all octaves meet in p = 0.
  Vec3 turbulence(Vec3d p, std::span<const Vec3d> offset) const;

  // The same in a plane: the curl of N3 alone at p.z, which has no divergence in x and y; z is 0.
  Vec3 planar_turbulence(Vec3d p, std::span<const Vec3d> offset) const;

  // The random numbers themselves, of the splines around (x, y, z): from 0 to size - 1 each.
  Vec3 coefficient(int x, int y, int z) const { return tile_[at(x, y, z)]; }

 private:
  std::size_t at(int x, int y, int z) const {
    const std::ptrdiff_t row = size_ + 2;
    return static_cast<std::size_t>(x + 1 + (y + 1 + (z + 1) * row) * row);
  }
  void fill_random(std::uint64_t key, Array<Vec3>& numbers) const;
  void add_band(const Array<Vec3>& numbers, int shift);
  void fill_ghosts();

  int size_ = 0;
  Array<Vec3> tile_;  // with one ghost at each end of each axis, so that 27 nodes are found without wrapping
};

}  // namespace curlew
