// A run that diverges says which pass and which particle, and leaves the world as it was before the step.
#include <catch2/catch.hpp>
#include <limits>

#include "sim/core/error.h"
#include "sim/core/watch.h"
#include "sim/measure/diagnostics.h"
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

TEST_CASE("a particle faster than the scene can make it has diverged, however small the step", "[scene]") {
  Run run(small_dam());
  run.take_steps(3);
  TimeParameters& time = run.world.scene.parameters.time;
  time.fixed_step = 1e-7;  // far below what time.max_displacement would notice
  time.max_energy = 1e6;
  run.take_steps(1);
  const double fall = std::sqrt(2 * 9.81 * 1);  // through the domain, from rest
  Array<Vec3>& velocity = run.world.fields.velocity;

  velocity[0] = {static_cast<float>(19 * fall), 0, 0, 0};
  run.take_steps(1);
  velocity[0] = {static_cast<float>(21 * fall), 0, 0, 0};
  const std::uint64_t before = state_hash(run.world.fields);
  const DivergedError error = failure_of(run);
  CHECK(error.particle == run.world.fields.id[0]);
  CHECK(std::string(error.what()).find("more than time.max_speed (20) times the 4.43 m/s") != std::string::npos);
  CHECK(state_hash(run.world.fields) == before);

  time.max_speed = 30;
  run.take_steps(1);
}

TEST_CASE("a pressure gradient along a periodic axis may drive the fluid as fast as it likes", "[scene]") {
  Scene scene = small_dam();
  scene.domain.periodic = {true, false, true};
  scene.gravity = {1, -9.81, 0};
  Run run(scene);
  run.world.scene.parameters.time.fixed_step = 1e-7;
  run.take_steps(1);
  run.world.fields.velocity[0] = {1000, 0, 0, 0};
  run.take_steps(1);
  CHECK(run.world.step == 2);
}

TEST_CASE("water with twice the energy of the start has diverged, unless something drives it", "[scene]") {
  Run run(small_dam());
  const double start = diagnose(run.world).total();
  run.simulate(0.1);
  const double rest = diagnose(run.world).potential;
  // Everything rises at one speed, so no pressure acts against it.
  const auto rise_to = [&](double energy) {
    const auto mass = double{run.world.mass} * static_cast<double>(run.world.count);
    const auto speed = static_cast<float>(std::sqrt(2 * (energy - rest) / mass));
    for (std::size_t i = 0; i < run.world.count; ++i) run.world.fields.velocity[i] = {0, speed, 0, 0};
  };

  rise_to(1.99 * start);
  run.take_steps(1);
  rise_to(2.05 * start);
  const std::uint64_t before = state_hash(run.world.fields);
  const DivergedError error = failure_of(run);
  const std::string sentence = error.what();
  CHECK(error.pass == "energy_watch");
  CHECK(sentence.find("more than time.max_energy (2) times the") != std::string::npos);
  CHECK(sentence.find("lower time.cfl") != std::string::npos);
  CHECK(state_hash(run.world.fields) == before);

  SECTION("it may go on when it is forgiven") {
    forgive(run.world);
    run.take_steps(1);
  }
  SECTION("models without the guard may add energy, as in their papers, and are not blamed for it afterwards") {
    run.world.scene.parameters.energy.guard = false;
    run.world.scene.parameters.micropolar.nu_t = 0.1;
    run.take_steps(1);
    run.world.scene.parameters.energy.guard = true;
    run.take_steps(1);
  }
  SECTION("so may moving walls") {
    run.world.scene.domain.walls[3].velocity = {1, 0, 0};
    run.take_steps(1);
  }
}

TEST_CASE("steps far beyond their limits end with a sentence, not in a storm", "[scene]") {
  Scene scene = at_particles_per_metre(bundled("dam_break_2d"), 30);
  TimeParameters& time = scene.parameters.time;
  time.cfl *= 4, time.acceleration_factor *= 4, time.max_step *= 4;
  Run run(scene);
  const double start = diagnose(run.world).total();
  CHECK_THROWS_AS(run.simulate(4), DivergedError);
  CHECK(diagnose(run.world).total() < 4 * start);
}
