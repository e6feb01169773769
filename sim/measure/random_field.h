// An isotropic random velocity field without divergence, of a given energy spectrum, in a periodic cube: the sum of its
// waves, so that it is exact at any place (Rogallo 1981, NASA TM 81315, has the same on a grid).
//
//   v(x) = sum over half the modes of 2 Re a(k) exp(i k x),   k . a = 0,   sum |a|^2 over a shell = E dk
#pragma once

#include <cstdint>
#include <vector>

#include "sim/core/vec.h"
#include "sim/measure/spectrum.h"

namespace curlew {

// E = k^(-5/3) from shell 1 to shell `last`, scaled to that energy (J/kg).
Spectrum kolmogorov_spectrum(double side, int last, double energy);

class RandomField {
 public:
  // Directions and phases from the seed; each shell has the energy of the spectrum, whose shell 0 is not used.
  RandomField(const Spectrum& spectrum, std::uint64_t seed);
  Vec3d at(Vec3d x) const;  // m/s, at x in m

 private:
  struct Wave {
    Vec3d cosine, sine;  // 2 Re a, -2 Im a
  };
  struct Row {
    int x, y, first_z;
    std::size_t begin, end;  // of its waves
  };
  double step_;
  int last_;
  std::vector<Row> rows_;  // waves with the same k_x and k_y
  std::vector<Wave> waves_;
};

}  // namespace curlew
