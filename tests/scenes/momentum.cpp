// What no wall and no gravity touches keeps its momentum, whatever happens inside.
#include <catch2/catch.hpp>
#include <random>

#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

Scene periodic_box_with_drop() {
  Scene scene = empty_box({1, 1, 1}, 20);
  scene.gravity = {};
  scene.domain.periodic = {true, true, true};
  scene.fluid.push_back(moving(Sphere{{0.5, 0.5, 0.5}, 0.3}, {0.8, -0.5, 0.3}));
  return scene;
}

// Particles off their lattice by up to 0.2 spacings, and a random velocity of each on top of the drift.
World disordered(const Scene& scene) {
  World world = jittered(make_world(scene), 0.2);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> speed(-0.3f, 0.3f);
  for (Vec3& v : world.fields.velocity) v += Vec3{speed(random), speed(random), speed(random)};
  return world;
}

}  // namespace

TEST_CASE("a drop in a periodic box keeps its momentum over 1000 steps", "[scene]") {
  Scene scene = periodic_box_with_drop();
  SECTION("inviscid") {}
  SECTION("with viscosity, scalar form") { scene.parameters.viscosity.nu = 0.01; }
  SECTION("with viscosity, vector form, and XSPH") {
    scene.parameters.viscosity.nu = 0.01;
    scene.parameters.viscosity.form = ViscosityParameters::form_t::vector;
    scene.parameters.micropolar.gamma = 0.1;
  }
  Run run(disordered(scene));
  const double scale = absolute_momentum(run.world);
  const Vec3d start = run.now().sums.momentum;
  run.take_steps(1000);
  const double drift = run.largest([&](const Moment& moment) { return length(moment.sums.momentum - start) / scale; });
  CHECK(drift <= 1e-6);
  // It did not simply fly on: the random part met pressure.
  CHECK(run.mean([](const Moment& moment) { return moment.report.density_error_true_avg; }) > 0);
  CHECK(run.now().sums.kinetic != Approx(run.history().front().sums.kinetic).epsilon(0.01));
}
