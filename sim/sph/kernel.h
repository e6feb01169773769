// The smoothing kernels, of support 2h, q = r/h, each bracket 0 where negative:
//   cubic spline (Monaghan 1992), W(r) = sigma/4 [ (2-q)^3 - 4 (1-q)^3 ],
//     sigma = 1/(pi h^3) in 3D, 10/(7 pi h^2) in 2D;
//   Wendland's C2 (Wendland 1995; Dehnen & Aly 2012, Table 1), W(r) = sigma (1 - q/2)^4 (1 + 2q),
//     sigma = 21/(16 pi h^3) in 3D, 7/(4 pi h^2) in 2D.
// With u = 2-q and v = 1-q both are u^3 (a + b u (5 - 2u)) - 4a v^3, one of a and b zero, so that no loop asks which.
// The gradient is grad W = slope(r) x_ij, slope = W'(r)/r (unit: 1/m^(D+2)).
#pragma once

#include "sim/core/simd.h"

namespace curlew {

enum class KernelKind { cubic, wendland };

class Kernel {
 public:
  Kernel() = default;
  // h in metres; dimension 2 or 3.
  Kernel(double h, int dimension, KernelKind kind = KernelKind::cubic);

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
    return u * u * u * (spline_ + wendland_ * u * (5.0f - 2.0f * u)) - 4.0f * spline_ * (v * v * v);
  }
  f8 slope(f8 r2) const {
    const f8 inverse_r = inverse_sqrt(max(r2, splat(tiny_)));
    const f8 q = r2 * inverse_r * inv_h_;
    const f8 u = max(2.0f - q, f8{}), v = max(1.0f - q, f8{});
    const f8 spline = spline_slope_ * inverse_r;
    return u * u * (spline + wendland_slope_ * u) - 4.0f * spline * (v * v);
  }

  // Sum of W over a lattice of spacing d, centre included (unit: 1/m^D).
  double lattice_sum(double d) const;

  // Sum of W over one layer of such a lattice, seen from a place over one of its points at distance z (unit: 1/m^D).
  double layer_sum(double d, double z) const;

  // 0.01 h^2, which keeps the Laplacian finite for close pairs (Monaghan 1992).
  float softening() const { return softening_; }

 private:
  double h_ = 1, a_ = 0, b_ = 0;
  int dimension_ = 3;
  float inv_h_ = 1, spline_ = 0, wendland_ = 0, spline_slope_ = 0, wendland_slope_ = 0, tiny_ = 1e-12f,
        softening_ = 0.01f;
};

}  // namespace curlew
