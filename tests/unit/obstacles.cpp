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

TEST_CASE("a body that moves holds particles where it is, and pushes them", "[obstacles]") {
  Scene scene = with_body(Sphere{{1, 0.5, 0.5}, 0.3});
  scene.bodies[0].motion = KeyframePath({{0, {}}, {1, {-1.2, 0.5, 0}}});
  const Obstacles ball(scene);
  const std::vector<BodyPlace> places{{{-1.2, 0.5, 0}, {0, 2, 0}}};  // its centre lies in the domain's upper corner
  Vec3 x{-0.2f, 1.29f, 0.5f}, v{1, 0.5f, 0};
  CHECK_FALSE(ball.contains(x));
  CHECK(ball.contains(x, places));
  CHECK_FALSE(ball.contains({1, 0.79f, 0.5f}, places));
  CHECK(ball.hold(x, v, x, places));
  CHECK(x.y == Approx(1.3).margin(1e-4));
  CHECK(v.x == Approx(1).margin(1e-3));
  CHECK(v.y == Approx(2).margin(1e-3));  // as fast as the ball
  Vec3 top{-0.2f, 1.29f, 0.5f}, faster{0, 3, 0};
  CHECK(ball.hold(top, faster, top, places));
  CHECK(faster.y == 3);
}

TEST_CASE("a body that moves off a wall has its end there", "[obstacles]") {
  Scene scene = with_body(Box{{0.5, 0, 0}, {1, 0.5, 1}});
  CHECK(Obstacles(scene).contains({0.51f, 0, 0.5f}));
  scene.bodies[0].motion = KeyframePath({{0, {}}, {1, {0.5, 0, 0}}});  // along it
  CHECK(Obstacles(scene).contains({0.51f, 0, 0.5f}));
  scene.bodies[0].motion = KeyframePath({{0, {}}, {1, {0, 0.5, 0}}});
  CHECK_FALSE(Obstacles(scene).contains({0.51f, 0, 0.5f}));
  CHECK_FALSE(Obstacles(scene).contains({0.51f, 0.49f, 0.5f}, body_places(scene.bodies, 1)));
  CHECK(Obstacles(scene).contains({0.51f, 0.51f, 0.5f}, body_places(scene.bodies, 1)));
}
