// Free fall in steps of dt is known to the last digit: v = g t, and symplectic Euler moves by g t (t + dt)/2.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/scenes/scene_test.h"

using namespace curlew;

TEST_CASE("a ball in free fall has velocity g t and has fallen g t (t + dt)/2", "[scene]") {
  const double dt = GENERATE(1.0 / 1024, 1e-3, 2e-3);
  Scene scene = bundled("free_fall");
  scene.parameters.time.fixed_step = dt;
  Run run(scene);
  const auto start = positions_by_id(run.world);
  run.simulate(0.5);

  const double t = static_cast<double>(run.step_number()) * dt, g = scene.gravity.y;
  const double velocity = g * t, fall = g * t * (t + dt) / 2;
  double velocity_error = 0, position_error = 0;
  const auto position = positions_by_id(run.world), speed = velocities_by_id(run.world);
  for (std::size_t i = 0; i < run.world.count; ++i) {
    velocity_error = std::max(velocity_error, length(speed[i] - Vec3d{0, velocity, 0}) / std::abs(velocity));
    position_error = std::max(position_error, length(position[i] - start[i] - Vec3d{0, fall, 0}) / std::abs(fall));
  }
  INFO("dt " << dt << " s, t " << t << " s");
  CHECK(t == Approx(0.5).margin(dt));
  CHECK(run.world.time == Approx(t).epsilon(1e-12));
  CHECK(velocity_error <= 1e-5);
  CHECK(position_error <= 1e-5);
}
