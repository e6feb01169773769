// Bodies that move by keyframes push water as pistons and balls do, and keep it out.
#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/io/checkpoint.h"
#include "sim/measure/state_hash.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

// Goes at an even speed (m/s) along x from `ramp` seconds on; before that it gathers speed.
KeyframePath even_motion(double speed, double ramp, double until) {
  std::vector<Keyframe> keyframes{{0, {}}};
  double x = 0.5 * speed * ramp;
  for (double time = ramp; time < until; time += ramp, x += speed * ramp) keyframes.push_back({time, {x, 0, 0}});
  return KeyframePath(std::move(keyframes));
}

Body moving_body(const char* name, Shape shape, KeyframePath motion, WallKind kind = WallKind::slip) {
  return {name, std::move(shape), kind, std::move(motion)};
}

double particles_in(const Run& run) {
  return run.largest([](const Moment& m) { return m.outside; });
}

Vec3d mean_velocity(const World& world) {
  return (1 / (double{world.mass} * static_cast<double>(world.count))) * diagnose(world).momentum;
}

// A plug of water in a long closed channel without gravity, a piston at rest at its left end.
Scene plug(int dimension, KeyframePath motion) {
  Scene scene = empty_box({2, 0.4, dimension == 3 ? 0.4 : 0.0}, dimension == 3 ? 20 : 40);
  scene.gravity = {};
  scene.fluid.push_back({Box{{0.3, 0, 0}, {0.9, 0.4, 0.4}}, {}});
  scene.bodies.push_back(moving_body("piston", Box{{0, -1, -1}, {0.3, 2, 2}}, std::move(motion)));
  return scene;
}

double extent(const World& world, bool high) {
  double x = high ? -1e300 : 1e300;
  for (const Vec3d& p : positions_by_id(world)) x = high ? std::max(x, p.x) : std::min(x, p.x);
  return x;
}

std::uint64_t hash_on(int threads, const Scene& scene, int steps) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Run run(scene);
  run.take_steps(steps);
  omp_set_num_threads(before);
  return state_hash(run.world.fields);
}

}  // namespace

TEST_CASE("a piston gives a plug of water its speed", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  const double speed = 0.5;
  Run run(plug(dimension, even_motion(speed, 0.1, 2)));
  const double length = extent(run.world, true) - extent(run.world, false);
  run.simulate(1);
  CHECK(particles_in(run) == 0);
  const Vec3d v = mean_velocity(run.world);
  const BodyPlace place = run.world.body_places[0];
  WARN(dimension << " v " << v.x << " " << v.y << " piston " << place.velocity.x << " at " << 0.3 + place.offset.x
                 << " rear " << extent(run.world, false) << " length " << extent(run.world, true) - extent(run.world, false)
                 << " of " << length << " rms " << rms_speed(run.world) << " steps " << run.step_number() << " limit "
                 << run.largest([](const Moment& m) { return m.report.limit_hits; }) << " contacts "
                 << run.largest([](const Moment& m) { return m.report.wall_contacts; }) << " comp "
                 << run.largest([](const Moment& m) { return m.report.density_error_true_avg; })<< " " <<
                 run.now().report.density_error_true_avg);
  CHECK(place.velocity.x == Approx(speed));
  CHECK(v.x == Approx(speed).epsilon(0.02));
}
