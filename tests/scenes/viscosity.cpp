// Viscous flows with an exact answer, and what walls do to them.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

constexpr double pi = std::numbers::pi;

// A channel along x, 1 m high, periodic, full of fluid of that viscosity (m^2/s) that moves at `speed` (m/s).
Scene channel(WallKind walls, double nu, double speed) {
  Scene scene = empty_box({0.5, 1, 0}, 20);
  scene.gravity = {};
  scene.domain.periodic[0] = true;
  scene.domain.walls[2].kind = scene.domain.walls[3].kind = walls;
  scene.fluid.push_back(moving(Box{{0, 0, 0}, {0.5, 1, 0}}, {speed, 0, 0}));
  scene.parameters.viscosity.nu = nu;
  return scene;
}

// The largest difference between v_x and an expected profile of height y.
template <class Profile>
double largest_deviation(const World& world, Profile&& expected) {
  double most = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const double y = double{world.fields.position[i].y};
    most = std::max(most, std::abs(double{world.fields.velocity[i].x} - expected(y)));
  }
  return most;
}

// Couette flow started from rest between y = 0 and a lid at y = 1 m that moves at 1 m/s (Morris et al. 1997, Eq. 25).
double couette(double y, double nu, double t) {
  double u = y;
  for (int n = 1; n < 200; ++n) {
    u += 2 / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::sin(n * pi * y) * std::exp(-nu * n * n * pi * pi * t);
  }
  return u;
}

double mean_speed(const Run& run) {
  return run.now().sums.momentum.x / (double{run.world.mass} * static_cast<double>(run.world.count));
}

}  // namespace

TEST_CASE("a moving lid draws the fluid into Couette flow", "[scene]") {
  const double nu = 0.1;
  Scene scene = channel(WallKind::no_slip, nu, 0);
  scene.domain.walls[3].velocity = {1, 0, 0};
  Run run(scene);
  run.simulate(0.5);
  const double t = run.world.time;
  const double early = largest_deviation(run.world, [&](double y) { return couette(y, nu, t); });
  CHECK(early <= 0.03);
  run.simulate(5.5);
  const double late = largest_deviation(run.world, [](double y) { return y; });
  CHECK(late <= 0.03);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
}

TEST_CASE("a no-slip wall at rest slows the fluid, a slip wall does not", "[scene]") {
  const double nu = 0.1;
  Run slip(channel(WallKind::slip, nu, 1)), rough(channel(WallKind::no_slip, nu, 1));
  slip.simulate(1);
  rough.simulate(1);
  CHECK(mean_speed(slip) == Approx(1).epsilon(1e-4));
  // Plug flow that starts to feel its walls: mean u = sum over odd n of 8/(n pi)^2 exp(-nu n^2 pi^2 t).
  double exact = 0;
  for (int n = 1; n < 100; n += 2) exact += 8 / (n * n * pi * pi) * std::exp(-nu * n * n * pi * pi * rough.world.time);
  CHECK(mean_speed(rough) == Approx(exact).epsilon(0.05));
}

TEST_CASE("a no-slip body slows the fluid, a slip body does not", "[scene]") {
  const auto floor_body = [](WallKind kind) {
    Scene scene = channel(WallKind::slip, 0.1, 1);
    scene.domain.max.y = 1.2;
    scene.fluid[0].shape = Box{{0, 0.2, 0}, {0.5, 1.2, 0}};
    scene.bodies.push_back({"floor", Box{{-1, -1, 0}, {2, 0.2, 0}}, kind});
    return scene;
  };
  Run slip(floor_body(WallKind::slip)), rough(floor_body(WallKind::no_slip));
  slip.simulate(1);
  rough.simulate(1);
  CHECK(mean_speed(slip) > 0.98);
  // Plug flow with one rough side: as between two rough sides twice as far apart.
  double exact = 0;
  for (int n = 1; n < 100; n += 2)
    exact += 8 / (n * n * pi * pi) * std::exp(-0.1 * n * n * pi * pi * rough.world.time / 4);
  CHECK(mean_speed(rough) == Approx(exact).epsilon(0.1));
}

TEST_CASE("a periodic shear wave decays at the rate nu k^2", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  Scene scene = empty_box({1, 1, dimension == 3 ? 1.0 : 0.0}, dimension == 3 ? 16 : 32);
  scene.gravity = {};
  scene.domain.periodic = {true, true, dimension == 3};
  // Slow: the wave is gone before it has wrung the lattice.
  scene.fluid.push_back(with_shear_wave(Box{{0, 0, 0}, scene.domain.max}, 0.05));
  scene.parameters.viscosity.nu = 0.05;
  scene.parameters.time.fixed_step = 2e-3;
  Run run(scene);
  const double start = shear_wave_amplitude(run.world), k = shear_wave_number(scene);
  CHECK(start == Approx(0.05).epsilon(1e-3));
  run.simulate(0.5);
  const double rate = std::log(start / shear_wave_amplitude(run.world)) / run.world.time;
  CHECK(rate == Approx(0.05 * k * k).epsilon(0.05));
}
