// A run that diverges says which pass and which particle, and leaves the world as it was before the step.
#include <catch2/catch.hpp>
#include <limits>

#include "sim/core/error.h"
#include "sim/measure/state_hash.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

Scene small_dam() {
  Scene scene = empty_box({1, 1, 0.5}, 16);
  scene.fluid.push_back({Box{{0, 0, 0}, {0.5, 0.75, 0.5}}, {}});
  return scene;
}

// What the DivergedError of the next step says.
DivergedError failure_of(Run& run) {
  try {
    run.take_steps(1);
  } catch (const DivergedError& error) {
    return error;
  }
  FAIL("the step did not diverge");
  throw std::logic_error("unreachable");
}

}  // namespace

TEST_CASE("an absurd time step diverges with pass and particle, and the world stays as it was", "[scene]") {
  Run run(small_dam());
  run.simulate(0.3);
  const std::uint64_t before = state_hash(run.world.fields);
  const double dt = run.world.dt, time = run.world.time;
  const std::int64_t step_number = run.world.step;
  run.world.scene.parameters.time.fixed_step = 1;

  const DivergedError error = failure_of(run);
  const std::string sentence = error.what();
  CHECK(error.pass == "apply_forces");
  CHECK(error.particle < run.world.count);
  CHECK(sentence.find("after pass " + error.pass + " particle " + std::to_string(error.particle)) != std::string::npos);
  CHECK(sentence.find("use a smaller time.fixed_step") != std::string::npos);
  CHECK(state_hash(run.world.fields) == before);
  CHECK(run.world.dt == dt);
  CHECK(run.world.time == time);
  CHECK(run.world.step == step_number);

  // With a sensible step it goes on as if nothing had happened.
  Run other(small_dam());
  other.simulate(0.3);
  run.world.scene.parameters.time.fixed_step = 0;
  run.take_steps(5);
  other.take_steps(5);
  CHECK(state_hash(run.world.fields) == state_hash(other.world.fields));
}

TEST_CASE("a velocity that is not finite is found at once, and named", "[scene]") {
  Run run(small_dam());
  run.take_steps(3);
  const std::size_t place = run.world.count / 2;
  run.world.fields.velocity[place].y = std::numeric_limits<float>::quiet_NaN();
  const std::uint64_t before = state_hash(run.world.fields);
  const DivergedError error = failure_of(run);
  CHECK(error.pass == "divergence_solve");
  CHECK(error.particle == run.world.fields.id[place]);
  CHECK(std::string(error.what()).find("has a velocity that is not finite") != std::string::npos);
  CHECK(state_hash(run.world.fields) == before);
}
