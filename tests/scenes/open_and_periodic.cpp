// Faces that are no walls: water leaves through open ones and comes back through periodic ones.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/scenes/scene_test.h"

using namespace curlew;

TEST_CASE("water leaves through an open face", "[scene]") {
  Scene scene = empty_box({1, 1, 0.5}, 20);
  scene.fluid.push_back({Box{{0, 0, 0}, {0.5, 0.75, 0.5}}, {}});
  scene.domain.walls[1].kind = WallKind::open;
  Run run(scene);
  const std::size_t start = run.world.count;
  std::size_t before = start;
  bool grew = false;
  while (run.world.time < 2) {
    run.take_steps(1);
    grew = grew || run.world.count > before;
    before = run.world.count;
  }
  CHECK_FALSE(grew);
  CHECK(run.world.count < start / 2);
  CHECK(run.world.count > 0);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
  auto id = run.world.fields.id;
  REQUIRE(id.size() == run.world.count);
  std::sort(id.begin(), id.end());
  CHECK(std::adjacent_find(id.begin(), id.end()) == id.end());
  double farthest = 0;
  for (const Vec3d& x : positions_by_id(run.world)) farthest = std::max(farthest, x.x);
  CHECK(farthest < 1 + 2 * scene.spacing());
}

TEST_CASE("a box whose water has all left goes on", "[scene]") {
  Scene scene = empty_box({0.5, 0.5, 0.5}, 20);
  for (Wall& wall : scene.domain.walls) wall.kind = WallKind::open;
  scene.fluid.push_back({Sphere{{0.25, 0.25, 0.25}, 0.15}, {}});
  Run run(scene);
  run.simulate(1);
  CHECK(run.world.count == 0);
  run.take_steps(2);
  CHECK(std::isfinite(run.now().sums.mechanical()));
}

TEST_CASE("a drop that drifts through periodic faces comes back to its place", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  Scene scene = empty_box({1, 0.8, dimension == 3 ? 0.9 : 0.0}, 20);
  scene.gravity = {};
  scene.domain.periodic = {true, true, dimension == 3};
  scene.parameters.time.fixed_step = 1.0 / 256;
  // Once round along x, twice along y, once back along z, each in 1 s.
  scene.fluid.push_back(moving(Sphere{{0.5, 0.4, 0.45}, 0.25}, {1, 1.6, dimension == 3 ? -0.9 : 0.0}));
  Run run(scene);
  const auto start = positions_by_id(run.world);
  run.simulate(1);
  CHECK(run.world.time == 1);
  const auto end = positions_by_id(run.world);
  double farthest = 0;
  for (std::size_t i = 0; i < start.size(); ++i) farthest = std::max(farthest, length(end[i] - start[i]));
  CHECK(farthest < 1e-4 * scene.spacing() * 20);
  // On the way it was elsewhere.
  run.simulate(0.25);
  CHECK(length(positions_by_id(run.world)[0] - start[0]) > 0.2);
}
