// The shapes of bodies as a last line.
#include "sim/sph/obstacles.h"

#include <catch2/catch.hpp>

#include "sim/scene/heightfield.h"

using namespace curlew;

namespace {

Scene with_body(Shape shape) {
  Scene scene;
  scene.particle_radius = 0.025;
  scene.domain.max = {2, 1, 1};
  scene.bodies.push_back({"body", std::move(shape), WallKind::slip});
  return scene;
}

}  // namespace

TEST_CASE("a particle in a body goes to its surface and loses the velocity into it", "[obstacles]") {
  const Obstacles ball(with_body(Sphere{{1, 0.5, 0.5}, 0.3}));
  Vec3 x{1, 0.79f, 0.5f}, v{1, -2, 0};
  CHECK(ball.contains(x));
  CHECK(ball.hold(x, v, {1, 0.81f, 0.5f}));
  CHECK(x.y == Approx(0.8).margin(1e-4));
  CHECK(x.x == Approx(1).margin(1e-4));
  CHECK(v.x == Approx(1).margin(1e-3));
  CHECK(v.y == Approx(0).margin(1e-3));
  CHECK(!ball.contains(x));
  Vec3 outside{1, 0.85f, 0.5f};
  CHECK(!ball.hold(outside, v, outside));
}

TEST_CASE("a face in the plane of a wall is no way out", "[obstacles]") {
  Heightfield beach;
  beach.formula = "0.5";
  beach.min = {1, 0, 0};
  beach.max = {2, 1, 1};
  load_heights(beach, ".", 3, "beach");
  const auto [name, shape] = GENERATE_COPY(table<std::string, Shape>({
      {"box", Box{{1, 0, 0}, {2, 0.5, 1}}},
      {"pillar", Cylinder{{1.5, 0, 0.5}, {1.5, 0.5, 0.5}, 0.5}},
      {"beach", beach},
  }));
  CAPTURE(name);
  const Obstacles body(with_body(shape));
  for (const float y : {0.0f, 1e-4f}) {  // held at the floor, 1 cm behind the front
    Vec3 x{1.01f, y, 0.5f}, v{1, 0, 0};
    CHECK(body.contains(x));
    CHECK(body.hold(x, v, {0.99f, 0, 0.5f}));
    CHECK(x.x == Approx(1).margin(1e-3));
    CHECK(x.y == Approx(double{y}).margin(1e-4));
    CHECK(v.x == Approx(0).margin(1e-3));
  }
}
