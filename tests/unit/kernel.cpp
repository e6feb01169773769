// The kernel against its defining properties.
#include "sim/sph/kernel.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace curlew;

namespace {

// Integral of f over all space, f a function of distance that vanishes beyond `end`.
template <class F>
double integral(int dimension, double end, F&& f) {
  constexpr int steps = 20000;
  double total = 0;
  for (int k = 0; k < steps; ++k) {
    const double r = (k + 0.5) * end / steps;
    const double shell = dimension == 3 ? 4 * std::numbers::pi * r * r : 2 * std::numbers::pi * r;
    total += f(r) * shell;
  }
  return total * end / steps;
}

constexpr KernelKind kinds[] = {KernelKind::cubic, KernelKind::wendland};

}  // namespace

TEST_CASE("the kernel integrates to one and is zero from its support on", "[kernel]") {
  for (const KernelKind kind : kinds) {
    for (int dimension : {2, 3}) {
      const Kernel kernel(0.03, dimension, kind);
      CHECK(integral(dimension, kernel.support(), [&](double r) { return kernel.value(r); }) ==
            Approx(1).epsilon(1e-6));
      CHECK(kernel.value(kernel.support()) == 0);
      CHECK(kernel.derivative(kernel.support()) == 0);
      CHECK(kernel.value(1.0) == 0);
    }
  }
}

TEST_CASE("the kernel's derivative is that of its value", "[kernel]") {
  for (const KernelKind kind : kinds) {
    const Kernel kernel(0.5, 3, kind);
    for (double r = 0.01; r < 1.0; r += 0.013) {
      const double e = 1e-6;
      CHECK(kernel.derivative(r) == Approx((kernel.value(r + e) - kernel.value(r - e)) / (2 * e)).margin(1e-6));
    }
  }
}

TEST_CASE("eight at a time equals one at a time", "[kernel][simd]") {
  const KernelKind kind = GENERATE(KernelKind::cubic, KernelKind::wendland);
  for (int dimension : {2, 3}) {
    const Kernel kernel(0.02, dimension, kind);
    for (int k = 0; k < 400; k += 8) {
      f8 r2{};
      for (int lane = 0; lane < 8; ++lane) r2[lane] = static_cast<float>(std::pow((k + lane) * 1.1e-4, 2));
      const f8 value = kernel.value(r2), slope = kernel.slope(r2);
      for (int lane = 0; lane < 8; ++lane) {
        const double r = std::sqrt(double{r2[lane]});
        CHECK(value[lane] == Approx(kernel.value(r)).epsilon(1e-5).margin(1e-6 * kernel.value(0)));
        if (r > 0)
          CHECK(slope[lane] * r == Approx(kernel.derivative(r)).epsilon(1e-5).margin(1e-5 * kernel.value(0) / 0.02));
      }
    }
  }
}

TEST_CASE("lattice sums of the cubic spline are those that the mass is corrected by", "[kernel]") {
  const double d = 0.1;
  CHECK(Kernel(d, 3).lattice_sum(d) * d * d * d == Approx(0.99997).margin(1e-5));
  CHECK(Kernel(d, 2).lattice_sum(d) * d * d == Approx(1.00086).margin(1e-5));
  CHECK(Kernel(1.3 * d, 3).lattice_sum(d) * d * d * d == Approx(0.9973).margin(1e-4));
}

TEST_CASE("Wendland's kernel has the values of its formula", "[kernel]") {
  const double h = 0.4, pi = std::numbers::pi;
  const Kernel plane(h, 2, KernelKind::wendland), space(h, 3, KernelKind::wendland);
  CHECK(plane.value(0.0) == Approx(7 / (4 * pi * h * h)));
  CHECK(space.value(0.0) == Approx(21 / (16 * pi * h * h * h)));
  CHECK(space.value(h) / space.value(0.0) == Approx(3.0 / 16));  // (1/2)^4 (1 + 2)
}
