// Taylor-Green vortices in a periodic square against the exact solution,
//   u = -U e^(bt) cos X sin Y,  v = U e^(bt) sin X cos Y,  X = 2 pi x / L,  b = -8 pi^2 nu / L^2.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/core/parallel.h"
#include "sim/core/passes.h"
#include "sim/scene/bundled.h"
#include "sim/scene/reader.h"

using namespace curlew;

namespace {

constexpr double tau = 2 * std::numbers::pi;

// Mean distance of the velocities from the exact ones, over the mean exact speed.
double velocity_error(const World& world, double decay) {
  double difference = 0, exact = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3d x = to_double(world.fields.position[i]), v = to_double(world.fields.velocity[i]);
    const Vec3d right{-decay * std::cos(tau * x.x) * std::sin(tau * x.y),
                      decay * std::sin(tau * x.x) * std::cos(tau * x.y), 0};
    difference += length(v - right);
    exact += length(right);
  }
  return difference / exact;
}

}  // namespace

TEST_CASE("Taylor-Green at Re 100 decays as it must, without voids", "[taylor-green]") {
  const Scene scene = read_scene(find_scene("taylor_green", std::string(CURLEW_SOURCE_DIR) + "/assets"));
  World world = make_world(scene);
  REQUIRE(world.count == 2500);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  while (world.time < 1) step(world, plan);
  const double decay = std::exp(-2 * tau * tau * scene.parameters.viscosity.nu * world.time);
  const double error = velocity_error(world, decay);
  const double kinetic =
      particle_sum(world.count,
                   [&](std::size_t i) { return double{dot(world.fields.velocity[i], world.fields.velocity[i])} / 2; }) /
      static_cast<double>(world.count);
  CAPTURE(error, kinetic / (0.25 * decay * decay));
  CHECK(error < 0.04);  // measured: 0.02; the aim was 0.08
  CHECK(kinetic == Approx(0.25 * decay * decay).epsilon(0.06));
  for (std::size_t i = 0; i < world.count; ++i) {
    REQUIRE(world.fields.density[i] > 970);  // a void shows as a hole in the density
    REQUIRE(world.fields.density[i] < 1030);
  }
}

TEST_CASE("the pressure between Taylor-Green vortices is the exact one", "[taylor-green]") {
  Scene scene = read_scene(find_scene("taylor_green", std::string(CURLEW_SOURCE_DIR) + "/assets"));
  scene.parameters.pressure.conserving = GENERATE(true, false);
  if (!scene.parameters.pressure.conserving) scene.parameters.pressure.divergence_tolerance = 1e-4;
  World world = make_world(scene);
  const Plan plan = make_plan(world, {FieldId::pressure});
  prepare(world, plan);
  // Slope of the pressure over p = -rho U^2 / 4 (cos 2X + cos 2Y), least squares over places and times.
  double product = 0, square = 0;
  while (world.time < 0.3) {
    step(world, plan);
    if (world.time < 0.1) continue;
    const double decay = std::exp(-2 * tau * tau * scene.parameters.viscosity.nu * world.time);
    for (std::size_t i = 0; i < world.count; ++i) {
      const Vec3d x = to_double(world.fields.position[i]);
      const double exact = -250 * decay * decay * (std::cos(2 * tau * x.x) + std::cos(2 * tau * x.y));
      product += exact * double{world.fields.pressure[i]};
      square += exact * exact;
    }
  }
  CAPTURE(scene.parameters.pressure.conserving, product / square);
  CHECK(product / square == Approx(1).epsilon(scene.parameters.pressure.conserving ? 0.02 : 0.1));
}
