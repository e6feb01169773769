// Vorticity refinement on losses that are known, and on flows that are.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/measure/state_hash.h"
#include "sim/turbulence/vorticity_refinement_liu2020.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

using Reconstruction = VorticityRefinementParameters::reconstruction_t;

// Water at rest on a periodic lattice, 96 spacings high and 1 mm apart.
Scene tall_lattice(int dimension, Reconstruction reconstruction) {
  Scene scene = empty_box({0.012, 0.096, dimension == 3 ? 0.012 : 0}, 1000);
  scene.domain.periodic = {true, true, dimension == 3};
  scene.gravity = {};
  scene.fluid = {moving(Box{{0, 0, 0}, scene.domain.max}, {})};
  scene.parameters.vorticity_refinement.alpha = 1;
  scene.parameters.vorticity_refinement.reconstruction = reconstruction;
  return scene;
}

// The share of a lost velocity v_x = sin(k y) that refinement brings back.
double response(const Scene& scene, double wave_length) {
  const double k = 2 * std::numbers::pi / wave_length;
  World world = make_world(scene);
  for (std::size_t i = 0; i < world.count; ++i) {
    world.fields.velocity[i] = to_float({std::sin(k * double{world.fields.position[i].y}), 0, 0});
  }
  prepare(world, make_plan(world));
  world.dt = 0;
  predict_vorticity(world);
  std::fill(world.fields.velocity.begin(), world.fields.velocity.end(), Vec3{});
  refine_vorticity(world);
  double back = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    back += 2 * double{world.fields.velocity[i].x} * std::sin(k * double{world.fields.position[i].y});
  }
  return back / static_cast<double>(world.count);
}

}  // namespace

TEST_CASE("the paper's sum gives back the share of each wave length that theory says", "[refinement]") {
  // A lattice sum over R = 1.99 d and two curls in the difference form, in Fourier space.
  const double spacings[] = {4, 6, 8, 12, 16, 32};
  const double in_3d[] = {0.565, 0.805, 0.642, 0.361, 0.220, 0.059};
  const double in_2d[] = {0.226, 0.340, 0.273, 0.155, 0.094, 0.026};
  for (int dimension : {2, 3}) {
    const Scene scene = tall_lattice(dimension, Reconstruction::sum);
    for (int k = 0; k < 6; ++k) {
      const double expected = dimension == 3 ? in_3d[k] : in_2d[k], found = response(scene, spacings[k] * 1e-3);
      INFO(dimension << "D, wave length " << spacings[k] << " d: " << found);
      CHECK(std::abs(found - expected) < 0.02);
    }
  }
}

TEST_CASE("the solve on a grid gives back waves of 6 spacings and more, and never too much", "[refinement]") {
  for (int dimension : {2, 3}) {
    const Scene scene = tall_lattice(dimension, Reconstruction::poisson);
    for (double spacings : {2.0, 3.0, 4.0, 4.8, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0}) {
      const double found = response(scene, spacings * 1e-3);
      INFO(dimension << "D, wave length " << spacings << " d: " << found);
      CHECK(found < 1.02);
      if (spacings >= 6) CHECK(found > 0.85);
    }
  }
}
