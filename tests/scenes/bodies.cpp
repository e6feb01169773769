// Bodies hold water out: no particle ever enters one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "sim/scene/heightfield.h"
#include "sim/scene/mesh.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

// A block of water that hangs over the middle of a box.
Scene water_over(Shape obstacle) {
  Scene scene = empty_box({1, 1.5, 1}, 24);
  scene.fluid.push_back(moving(Box{{0.25, 0.75, 0.25}, {0.75, 1.25, 0.75}}, {0, -1, 0}));
  scene.bodies.push_back({"obstacle", std::move(obstacle), WallKind::slip});
  return scene;
}

Shape rock() {
  Mesh rock{CURLEW_ASSETS_DIR "/meshes/rock.obj", 0.3, {0.5, 0.3, 0.5}, {0, 25, 0}, nullptr};
  rock.mesh =
      std::make_shared<TriangleMesh>(transformed(load_mesh(rock.file), rock.scale, rock.rotation, rock.translation));
  return rock;
}

double lowest(const World& world) {
  double y = 1e300;
  for (const Vec3d& x : positions_by_id(world)) y = std::min(y, x.y);
  return y;
}

}  // namespace

TEST_CASE("water poured on a body runs off it and never enters", "[scene]") {
  const auto [name, shape] = GENERATE(table<std::string, Shape>({
      {"sphere", Sphere{{0.5, 0.35, 0.5}, 0.3}},
      {"cylinder", Cylinder{{0.5, 0.4, -0.2}, {0.5, 0.4, 1.2}, 0.2}},
      {"upright cylinder", Cylinder{{0.5, -0.2, 0.5}, {0.5, 0.6, 0.5}, 0.2}},
      {"rock", rock()},
  }));
  CAPTURE(name);
  Run run(water_over(shape));
  CHECK(run.history().front().outside == 0);
  run.simulate(1);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
  CHECK(run.largest([](const Moment& m) { return m.report.limit_hits; }) == 0);
  CHECK(run.energy_rise(0.5) <= 1e-3);
  CHECK(lowest(run.world) < 0.05);  // it did run off
}

TEST_CASE("a column of water on a body at rest does not leak", "[scene]") {
  const double top = 0.25;
  Scene scene = empty_box({0.5, 1.25, 0.5}, 24);
  scene.parameters.viscosity.nu = 0.01;
  scene.fluid.push_back({Box{{0, top, 0}, {0.5, top + 0.75, 0.5}}, {}});
  SECTION("that fills the floor") { scene.bodies.push_back({"floor", Box{{-1, -1, -1}, {2, top, 2}}, WallKind::slip}); }
  SECTION("that is a basin") {
    const double edge = 0.125;
    scene.fluid[0].shape = Box{{edge, top, edge}, {0.5 - edge, top + 0.75, 0.5 - edge}};
    scene.bodies.push_back({"floor", Box{{-1, -1, -1}, {2, top, 2}}, WallKind::slip});
    scene.bodies.push_back({"left", Box{{-1, top, -1}, {edge, 2, 2}}, WallKind::slip});
    scene.bodies.push_back({"right", Box{{0.5 - edge, top, -1}, {2, 2, 2}}, WallKind::slip});
    scene.bodies.push_back({"back", Box{{edge, top, -1}, {0.5 - edge, 2, edge}}, WallKind::slip});
    scene.bodies.push_back({"front", Box{{edge, top, 0.5 - edge}, {0.5 - edge, 2, 2}}, WallKind::slip});
  }
  Run run(scene);
  run.simulate(0.5);  // it settles
  const double settled = run.now().sums.potential;
  run.simulate(0.5);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
  CHECK(lowest(run.world) >= top);
  CHECK(run.now().sums.potential == Approx(settled).epsilon(0.01));
  CHECK(run.energy_rise(0.5) <= 1e-3);
}

// Off a wall it stands half a spacing. Samples have gaps between them, and under its weight water settles towards
// those.
TEST_CASE("water stands close to a body, and not in it", "[scene]") {
  const double top = 0.25;
  Scene scene = empty_box({0.5, 1.25, 0.5}, 24);
  scene.parameters.viscosity.nu = 0.01;
  scene.fluid.push_back({Box{{0, top, 0}, {0.5, top + 0.75, 0.5}}, {}});
  scene.bodies.push_back({"floor", Box{{-1, -1, -1}, {2, top, 2}}, WallKind::slip});
  Run run(scene);
  run.simulate(1);
  double sum = 0, number = 0;
  for (const Vec3d& x : positions_by_id(run.world)) {
    if (x.y - top > 0.75 * scene.spacing()) continue;
    sum += x.y - top;
    ++number;
  }
  CHECK(number >= 90);  // of 144 in the lattice's first layer
  CHECK(number <= 150);
  CHECK(sum / number >= 0.15 * scene.spacing());
  CHECK(sum / number <= 0.55 * scene.spacing());
  CHECK_NOFAIL(number == Approx(12 * 12).epsilon(0.15));  // the aim: as off a wall
  CHECK_NOFAIL(sum / number == Approx(0.5 * scene.spacing()).margin(0.1 * scene.spacing()));
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
}

TEST_CASE("what meets a body alone stops at its surface", "[scene]") {
  Scene scene = empty_box({1, 1, 1}, 20);
  scene.fluid.push_back(moving(Box{{0.45, 0.85, 0.45}, {0.5, 0.9, 0.5}}, {0.3, -2, 0}));
  scene.bodies.push_back({"plate", Box{{0.2, 0.3, 0.2}, {0.8, 0.4, 0.8}}, WallKind::slip});
  Run run(scene);
  CHECK(run.world.count == 1);
  run.simulate(0.4);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
  CHECK(lowest(run.world) >= 0.4);
  CHECK(positions_by_id(run.world)[0].x > 0.55);  // it slides on
}

TEST_CASE("a body that stands on the floor stops a drop that slides on it", "[scene]") {
  Scene scene = empty_box({2, 1, 1}, 20);
  scene.fluid.push_back(moving(Box{{0.3, 0, 0.45}, {0.35, 0.05, 0.5}}, {2, 0, 0}));
  const Heightfield beach = [&] {
    Heightfield field;
    field.formula = "max(0, 0.6*(x - 0.9))";
    field.min = {0, 0, 0};
    field.max = {2, 1, 1};
    load_heights(field, ".", 3, "beach");
    return field;
  }();
  const auto [name, shape, farthest] = GENERATE_COPY(table<std::string, Shape, double>({
      {"box", Box{{1, 0, 0}, {1.2, 0.5, 1}}, 1.0},
      {"pillar", Cylinder{{1, 0, 0.48}, {1, 0.5, 0.48}, 0.2}, 0.81},
      {"beach", beach, 2},
  }));
  CAPTURE(name);
  scene.bodies.push_back({name, shape, WallKind::slip});
  Run run(scene);
  CHECK(run.world.count == 1);
  for (int k = 0; k < 200; ++k) {
    run.take_steps(1);
    const Vec3d x = positions_by_id(run.world)[0];
    REQUIRE(x.x <= farthest + 1e-3);
    if (name == "beach" && x.x > 1) REQUIRE(x.y >= 0.6 * (x.x - 0.9) - 1e-3);
  }
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
}

TEST_CASE("a thin strip in 2D is sampled where it is", "[scene]") {
  Scene scene = empty_box({1, 1, 0}, 20);
  scene.dimension = 2;
  scene.fluid.push_back({Box{{0, 0.6, 0}, {1, 0.9, 0}}, {}});
  scene.bodies.push_back({"strip", Cylinder{{0.2, 0.3, 0}, {0.8, 0.35, 0}, 0.02}, WallKind::slip});
  Run run(scene);
  CHECK(run.world.bodies.count() >= 10);
  for (const Vec3& x : run.world.bodies.position()) CHECK(std::abs(double{x.y} - 0.325) < 0.05);
  run.simulate(0.5);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
}
