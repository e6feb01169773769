#include "sim/sph/kernel.h"

#include <algorithm>
#include <numbers>

namespace curlew {

Kernel::Kernel(double h, int dimension, KernelKind kind) : h_(h), dimension_(dimension) {
  using std::numbers::pi;
  if (kind == KernelKind::cubic) {
    a_ = (dimension == 3 ? 1 / (pi * h * h * h) : 10 / (7 * pi * h * h)) / 4;
  } else {
    b_ = (dimension == 3 ? 21 / (16 * pi * h * h * h) : 7 / (4 * pi * h * h)) / 16;
  }
  inv_h_ = static_cast<float>(1 / h);
  spline_ = static_cast<float>(a_);
  wendland_ = static_cast<float>(b_);
  spline_slope_ = static_cast<float>(-3 * a_ / h);
  wendland_slope_ = static_cast<float>(-10 * b_ / (h * h));
  tiny_ = static_cast<float>(1e-12 * h * h);
  softening_ = static_cast<float>(0.01 * h * h);
}

double Kernel::value(double r) const {
  const double q = r / h_, u = std::max(2 - q, 0.0), v = std::max(1 - q, 0.0);
  return u * u * u * (a_ + b_ * u * (5 - 2 * u)) - 4 * a_ * v * v * v;
}

double Kernel::derivative(double r) const {
  const double q = r / h_, u = std::max(2 - q, 0.0), v = std::max(1 - q, 0.0);
  return (-3 * a_ * (u * u - 4 * v * v) - 10 * b_ * q * u * u * u) / h_;
}

double Kernel::lattice_sum(double d) const {
  const int reach = static_cast<int>(support() / d) + 1, reach_z = dimension_ == 3 ? reach : 0;
  double total = 0;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach_z; z <= reach_z; ++z) total += value(d * std::sqrt(x * x + y * y + z * z));
    }
  }
  return total;
}

double Kernel::layer_sum(double d, double z) const {
  const int reach = static_cast<int>(std::ceil(support() / d));
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = dimension_ == 3 ? -reach : 0; j <= (dimension_ == 3 ? reach : 0); ++j) {
      sum += value(std::sqrt(z * z + d * d * (i * i + j * j)));
    }
  }
  return sum;
}

}  // namespace curlew
