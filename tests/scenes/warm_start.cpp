// The warm start of the pressure solves is a pressure, not an impulse: a time step that jumps turns it into no energy.
#include <catch2/catch.hpp>

#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

Scene small_tank() {
  Scene scene = empty_box({0.5, 1, 0.5}, 24);
  scene.fluid.push_back({Box{{0, 0, 0}, {0.5, 0.5, 0.5}}, {}});
  return scene;
}

// Time steps that jump between 1 ms and 4 ms, every step or every few.
void simulate_in_jumps(Run& run, double seconds, int steps_between) {
  for (int k = 0; run.world.time < seconds; ++k) {
    run.world.scene.parameters.time.fixed_step = k / steps_between % 2 == 0 ? 1e-3 : 4e-3;
    run.take_steps(1);
  }
}

}  // namespace

TEST_CASE("a time step that jumps between 1 ms and 4 ms adds no energy", "[scene]") {
  const int steps_between = GENERATE(1, 10);
  CAPTURE(steps_between);
  Scene scene = small_tank();
  SECTION("at rest") {}
  SECTION("sloshing") {
    scene.fluid[0].shape = Box{{0, 0, 0}, {0.25, 0.5, 0.5}};
    scene.fluid.push_back({Box{{0.25, 0, 0}, {0.5, 0.375, 0.5}}, {}});
  }
  Run run(scene);
  simulate_in_jumps(run, 1.5, steps_between);
  CHECK(run.energy_rise(0.5) <= 1e-3);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
}
