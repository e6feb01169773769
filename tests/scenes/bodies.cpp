// Bodies hold water out: no particle ever enters one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>

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

// Known to fail: bodies are sampled on their surface, where one layer holds the fluid 0.93 to 0.97 spacings off.
TEST_CASE("water stands half a spacing off a body, as it does off a wall", "[scene][!mayfail]") {
  const double top = 0.25;
  Scene scene = empty_box({0.5, 1.25, 0.5}, 24);
  scene.parameters.viscosity.nu = 0.01;
  scene.fluid.push_back({Box{{0, top, 0}, {0.5, top + 0.75, 0.5}}, {}});
  scene.bodies.push_back({"floor", Box{{-1, -1, -1}, {2, top, 2}}, WallKind::slip});
  Run run(scene);
  run.simulate(1);
  double sum = 0, number = 0;
  for (const Vec3d& x : positions_by_id(run.world)) {
    if (x.y - top > 1.2 * scene.spacing()) continue;
    sum += x.y - top;
    ++number;
  }
  CHECK(number == Approx(12 * 12).epsilon(0.15));  // one layer
  CHECK(sum / number == Approx(0.5 * scene.spacing()).margin(0.1 * scene.spacing()));
}
