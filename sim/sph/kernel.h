// The smoothing kernel: cubic spline of Monaghan (1992), support 2h.
//   W(r) = sigma/4 [ (2-q)^3 - 4 (1-q)^3 ],  q = r/h, each bracket 0 where negative,
//   sigma = 1/(pi h^3) in 3D, 10/(7 pi h^2) in 2D.
// The gradient is grad W = slope(r) x_ij, slope = W'(r)/r (unit: 1/m^(D+2)).
#pragma once

#include "sim/core/simd.h"

namespace curlew {

class Kernel {
 public:
  Kernel() = default;
  // h in metres; dimension 2 or 3.
  Kernel(double h, int dimension);

  double support() const { return 2 * h_; }
  double h() const { return h_; }
  int dimension() const { return dimension_; }

  // In double, for tables and tests.
  double value(double r) const;
  double derivative(double r) const;

  // Eight squared distances at once. A coincident pair (r2 = 0) has slope times x_ij = 0.
  f8 value(f8 r2) const {
    const f8 q = r2 * inverse_sqrt(max(r2, splat(tiny_))) * inv_h_;
    const f8 u = max(2.0f - q, f8{}), v = max(1.0f - q, f8{});
    return quarter_sigma_ * (u * u * u - 4.0f * (v * v * v));
  }
  f8 slope(f8 r2) const {
    const f8 inverse_r = inverse_sqrt(max(r2, splat(tiny_)));
    const f8 q = r2 * inverse_r * inv_h_;
    const f8 u = max(2.0f - q, f8{}), v = max(1.0f - q, f8{});
    return slope_factor_ * inverse_r * (u * u - 4.0f * (v * v));
  }

  // Sum of W over a lattice of spacing d, centre included (unit: 1/m^D).
  double lattice_sum(double d) const;

  // Sum of W over one layer of such a lattice, seen from a place over one of its points at distance z (unit: 1/m^D).
  double layer_sum(double d, double z) const;

  // 0.01 h^2, which keeps the Laplacian finite for close pairs (Monaghan 1992).
  float softening() const { return softening_; }

 private:
  double h_ = 1, sigma_ = 1;
  int dimension_ = 3;
  float inv_h_ = 1, quarter_sigma_ = 0, slope_factor_ = 0, tiny_ = 1e-12f, softening_ = 0.01f;
};

}  // namespace curlew
