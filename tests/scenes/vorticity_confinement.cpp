// Vorticity confinement on a vortex whose push is known on paper.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/turbulence/vorticity_confinement_macklin2013.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

constexpr double core = 0.1;       // m
constexpr double turn_rate = 4.0;  // 1/s, in the middle

// A swirl in the middle of a periodic square, v = turn_rate r exp(-r^2 / (2 core^2)) around it.
World swirl(double epsilon, int particles_per_metre) {
  Scene scene = at_particles_per_metre(bundled("taylor_green"), particles_per_metre);
  scene.fluid[0].jitter = 0;  // the sums are to be compared with paper
  scene.parameters.viscosity.nu = 0;
  scene.parameters.energy.guard = false;
  scene.parameters.vorticity_confinement.epsilon = epsilon;
  World world = make_world(scene);
  for (std::size_t i = 0; i < world.count; ++i) {
    const double x = double{world.fields.position[i].x} - 0.5, y = double{world.fields.position[i].y} - 0.5;
    const double rate = turn_rate * std::exp(-(x * x + y * y) / (2 * core * core));
    world.fields.velocity[i] = to_float({-rate * y, rate * x, 0});
  }
  return world;
}

}  // namespace

TEST_CASE("confinement pushes along the swirl with epsilon times the vorticity") {
  const double epsilon = 0.3;
  Run run(swirl(epsilon, 100));
  World& world = run.world;
  std::fill(world.fields.acceleration.begin(), world.fields.acceleration.end(), Vec3{});
  vorticity_confinement(world);
  int compared = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const double x = double{world.fields.position[i].x} - 0.5, y = double{world.fields.position[i].y} - 0.5;
    const double r = std::hypot(x, y), q = r / core;
    if (r < 0.3 * core || r > core) continue;  // |omega| has its peak in the middle, its zero at sqrt(2) core
    ++compared;
    const double push = epsilon * turn_rate * (2 - q * q) * std::exp(-q * q / 2);
    const Vec3d a = to_double(world.fields.acceleration[i]);
    CHECK(length(a - Vec3d{-push * y / r, push * x / r, 0}) < 0.03 * push);
  }
  CHECK(compared > 200);
}

TEST_CASE("rigid rotation is not pushed") {
  Run run(swirl(1, 50));
  World& world = run.world;
  // The same vorticity everywhere has no core to point to.
  std::fill(world.fields.vorticity.begin(), world.fields.vorticity.end(), Vec3{0, 0, 2});
  std::fill(world.fields.acceleration.begin(), world.fields.acceleration.end(), Vec3{});
  vorticity_confinement(world);
  for (const Vec3& a : world.fields.acceleration) CHECK(length(a) == 0);
}

TEST_CASE("confinement keeps a swirl alive, and off it changes nothing") {
  const auto kinetic_after = [](double epsilon, int steps) {
    Run run(swirl(epsilon, 50));
    run.take_steps(steps);
    return run.now().sums.kinetic;
  };
  CHECK(kinetic_after(0.1, 10) > 1.001 * kinetic_after(0, 10));
  const double lost = kinetic_after(0, 200), kept = kinetic_after(0.02, 200);
  CHECK(kept > lost);
}
