// Fluid sampling: exact counts, distances to walls and bodies, overlaps, order, initial velocities.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/core/error.h"
#include "sim/scene/reader.h"
#include "sim/scene/sampling.h"
#include "sim/scene/shapes.h"
#include "tests/unit/sampling_measure.h"

using namespace curlew;
using namespace curlew::test;

namespace {

Scene tank(int dimension = 3) {
  Scene scene;
  scene.dimension = dimension;
  scene.domain.min = {0, 0, 0};
  scene.domain.max = {2, 2, dimension == 3 ? 1.0 : 0.0};
  scene.particle_radius = 0.025;
  return scene;
}

double least_distance(const std::vector<Vec3d>& points, double reach) {
  const Cloud cloud(points, reach);
  double least = reach;
  for (std::size_t i = 0; i < points.size(); ++i) least = std::min(least, cloud.nearest(points[i], i));
  return least;
}

}  // namespace

TEST_CASE("a cube of n spacings holds n^3 particles", "[sampling]") {
  for (int n = 1; n <= 79; n += n < 30 ? 1 : 7) {  // 1 to 30, then 37, 44, ... 79
    Scene scene = tank();
    scene.fluid = {{Box{{0, 0, 0}, {1, 1, 1}}, {}}};
    scene.particle_radius = 1.0 / n / 2;
    INFO("n = " << n);
    REQUIRE(count_particles(scene) == n * n * n);
    scene.domain.min = {-0.7, -0.3, 0.1};  // the same where the corner is no round number
    scene.domain.max = {1.3, 1.7, 1.1};
    scene.fluid = {{Box{{-0.7, -0.3, 0.1}, {0.3, 0.7, 1.1}}, {}}};
    REQUIRE(count_particles(scene) == n * n * n);
  }
}

TEST_CASE("particles lie a radius from walls and in the order x, y, z", "[sampling]") {
  Scene scene = tank();
  scene.fluid = {{Box{{0, 0, 0}, {0.2, 0.1, 0.15}}, {}}};
  const auto [position, velocity] = sample_fluid(scene);
  REQUIRE(position.size() == 4 * 2 * 3);
  CHECK(velocity.size() == position.size());
  const auto near = [](Vec3d a, Vec3d b) { return length(a - b) < 1e-12; };
  CHECK(near(position[0], {0.025, 0.025, 0.025}));
  CHECK(near(position[1], {0.025, 0.025, 0.075}));
  CHECK(near(position[3], {0.025, 0.075, 0.025}));
  CHECK(near(position[6], {0.075, 0.025, 0.025}));
}

TEST_CASE("a box that the spacing does not divide fills evenly from its minimum", "[sampling]") {
  Scene scene = tank();
  scene.fluid = {{Box{{0.513, 0, 0}, {0.713, 0.1, 0.05}}, {}}};
  const auto position = sample_fluid(scene).position;
  REQUIRE(position.size() == 4 * 2);
  CHECK(position[0].x == Approx(0.538));
  scene.fluid = {{Box{{1.9, 0, 0}, {2, 0.13, 0.05}}, {}}};  // 2.6 spacings: three layers, rounded
  CHECK(count_particles(scene) == 2 * 3);
  scene.fluid = {{Box{{1.9, 0, 0}, {2, 0.12, 0.05}}, {}}};  // 2.4 spacings: two
  CHECK(count_particles(scene) == 2 * 2);
  scene.fluid = {{Box{{1.9, 0, 0}, {2, 0.13, 0.05}}, {}}};
  scene.domain.max.y = 0.13;  // but none that would touch a wall
  CHECK(count_particles(scene) == 2 * 2);
}

TEST_CASE("fluid that reaches out of the domain is cut off", "[sampling]") {
  Scene scene = tank();
  scene.fluid = {{Box{{-5, -5, -5}, {0.5, 0.5, 5}}, {}}};
  CHECK(count_particles(scene) == 10 * 10 * 20);
  scene.fluid = {{Plane{{0, 0.5, 0}, {0, 1, 0}}, {}}};
  CHECK(count_particles(scene) == 40 * 10 * 20);
}

TEST_CASE("round fluid has its volume in particles", "[sampling]") {
  Scene scene = tank();
  scene.particle_radius = 0.01;
  const auto volume_of = [&](const Shape& shape) {
    scene.fluid = {{shape, {}}};
    return static_cast<double>(count_particles(scene)) * std::pow(scene.spacing(), scene.dimension);
  };
  CHECK(volume_of(Sphere{{1, 1, 0.5}, 0.3}) == Approx(4 * std::numbers::pi / 3 * 0.027).epsilon(0.02));
  CHECK(volume_of(Cylinder{{1, 0.5, 0.5}, {1, 1.5, 0.5}, 0.3}) == Approx(std::numbers::pi * 0.09).epsilon(0.02));
  scene.dimension = 2;
  CHECK(volume_of(Sphere{{1, 1, 0}, 0.3}) == Approx(std::numbers::pi * 0.09).epsilon(0.02));
}

TEST_CASE("particles keep a radius from every kind of body", "[sampling]") {
  Scene scene = tank();
  const Scene mesh_scene = parse_scene(R"json({"curlew": 1, "domain": {"min": [0, 0, 0], "max": [2, 2, 1]},
      "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}],
      "bodies": [{"mesh": {"file": "rock.obj", "scale": 0.3, "translation": [1, 0.5, 0.5]}},
                 {"heightfield": {"formula": "0.2 + 0.1*sin(3*x)", "min": [0, 0, 0], "max": [2, 1, 1]}}]})json",
                                       CURLEW_ASSETS_DIR "/meshes/scene.json");
  const std::vector<Shape> shapes{
      Box{{0.5, 0, 0.3}, {0.8, 0.6, 0.7}}, Sphere{{1, 0.5, 0.5}, 0.3}, Cylinder{{1, 0, 0.5}, {1.2, 1, 0.5}, 0.2},
      Plane{{0, 0.21, 0}, {0.1, 1, 0}},    mesh_scene.bodies[0].shape, mesh_scene.bodies[1].shape};
  for (const Shape& shape : shapes) {
    INFO(shape_name(shape));
    scene.bodies = {{"body", shape, WallKind::slip}};
    scene.fluid = {{Box{{0, 0, 0}, {2, 1, 1}}, {}}};
    const auto position = sample_fluid(scene).position;
    const std::size_t removed = 40 * 20 * 20 - position.size();
    const ShapeProbe probe(shape, 3);
    for (const Vec3d& p : position) REQUIRE(probe.distance(p, 0.1) >= 0.025 * (1 - 1e-5));
    // The body's volume is gone, and about half a spacing around it.
    const double volume_gone = static_cast<double>(removed) * std::pow(0.05, 3);
    CHECK(volume_gone > volume(shape, 3, scene.domain) * 0.98);
    CHECK(volume_gone < volume(shape, 3, scene.domain) + 0.05 * surface_area(shape, 3, scene.domain) + 0.02);
  }
}

TEST_CASE("fluid begins half a spacing clear of a body", "[sampling]") {
  Scene scene = tank();
  scene.bodies = {{"block", Box{{0.5, 0, 0}, {1, 0.5, 1}}, WallKind::slip}};
  scene.fluid = {{Box{{0, 0, 0}, {2, 0.5, 1}}, {}}};
  CHECK(count_particles(scene) == 30 * 10 * 20);  // up to the block on either side
}

TEST_CASE("where fluids overlap the first wins, and none comes nearer than 0.7 spacings", "[sampling]") {
  Scene scene = tank();
  scene.fluid = {{Box{{0, 0, 0}, {0.5, 0.5, 0.5}}, {}}, {Box{{0, 0, 0}, {0.5, 0.5, 0.5}}, {}}};
  CHECK_THROWS_AS(sample_fluid(scene), InputError);  // nothing is left for the second
  scene.fluid[1].shape = Box{{0.25, 0, 0}, {0.75, 0.5, 0.5}};
  CHECK(count_particles(scene) == 15 * 10 * 10);
  scene.fluid[1].shape = Sphere{{0.5, 0.513, 0.491}, 0.3};
  scene.fluid.push_back({Box{{0.12, 0.5, 0}, {1, 0.8, 0.5}}, {}});
  const auto position = sample_fluid(scene).position;
  CHECK(least_distance(position, 0.06) >= 0.7 * 0.05);
}

TEST_CASE("periodic boxes fill without a seam", "[sampling]") {
  Scene scene = tank(2);
  scene.domain.max = {1, 1, 0};
  scene.domain.periodic = {true, true, false};
  for (const int n : {20, 50, 49}) {
    scene.particle_radius = 0.5 / n;
    scene.fluid = {{Box{{0, 0, 0}, {1, 1, 0}}, {}}};
    CHECK(count_particles(scene) == n * n);
  }
  // A box that is shifted against the domain wraps onto itself: its last layer must not touch its first.
  scene.particle_radius = 0.025;
  scene.fluid = {{Box{{0.012, 0, 0}, {1, 1, 0}}, {}}};
  const auto position = sample_fluid(scene).position;
  auto wrapped = position;
  for (const Vec3d& p : position) {
    if (p.x < 0.1) wrapped.push_back(p + Vec3d{1, 0, 0});
  }
  CHECK(least_distance(wrapped, 0.06) >= 0.7 * 0.05);
}

TEST_CASE("sampling is the same every time", "[sampling]") {
  const Scene scene = read_scene(CURLEW_ASSETS_DIR "/scenes/rock.json");
  const auto first = sample_fluid(scene), second = sample_fluid(scene);
  CHECK(first.position == second.position);
  CHECK(first.velocity == second.velocity);
}

TEST_CASE("initial fields have their formulas", "[sampling]") {
  using Field = InitialVelocity::Field;
  Scene scene = tank(2);
  scene.domain.min = {1, 2, 0};
  scene.domain.max = {3, 6, 0};
  const auto at = [&](const InitialVelocity& field, Vec3d p) { return initial_velocity(field, p, scene); };
  const auto near = [](Vec3d a, Vec3d b) { return length(a - b) < 1e-12; };
  const double s = std::sin(0.3), c = std::cos(0.3), scale = 1 / (2 * std::numbers::pi);
  const Vec3d p{1 + 2 * 0.3 * scale, 2 + 4 * 0.3 * scale, 0};  // both phases are 0.3
  CHECK(near(at({Field::taylor_green, {}, 5, {}, {}}, p), {-5 * c * s, 5 * s * c, 0}));
  CHECK(near(at({Field::shear_wave, {}, 5, {}, {}}, p), {5 * s, 0, 0}));
  CHECK(near(at({Field::rotation, {}, 1, {1, 2, 0}, {0, 0, 3}}, {2, 4, 0}), {-6, 3, 0}));
  CHECK(near(at({Field::constant, {1, 2, 0}, 1, {}, {}}, p), {1, 2, 0}));
  const InitialVelocity gresho{Field::gresho_chan, {}, 2, {1, 2, 0}, {}, 0.2, 0};
  CHECK(near(at(gresho, {1, 2, 0}), {}));
  CHECK(near(at(gresho, {1.1, 2, 0}), {0, 1, 0}));
  CHECK(near(at(gresho, {1, 1.7, 0}), {1, 0, 0}));
  CHECK(near(at(gresho, {1.41, 2, 0}), {}));
  // nu t = 0.001 of Gamma = 1, at r = 0.02 and 0.2: the exact solution to eight digits.
  const InitialVelocity lamb{Field::lamb_oseen, {}, 1, {1, 2, 0}, {}, std::sqrt(0.004), 1};
  CHECK(near(at(lamb, {1, 2, 0}), {}));
  CHECK(at(lamb, {1.02, 2, 0}).y == Approx(0.75727977).epsilon(1e-7));
  CHECK(at(lamb, {1, 2.2, 0}).x == Approx(-0.79573859).epsilon(1e-7));
  scene.dimension = 3;
  scene.domain.max.z = 1;
  CHECK(
      near(at({Field::taylor_green, {}, 5, {}, {}}, p + Vec3d{0, 0, 0.3 * scale}), {5 * s * c * c, -5 * c * s * c, 0}));
  CHECK(near(at({Field::rotation, {}, 1, {0, 0, 0}, {1, 0, 0}}, {0, 2, 3}), {0, -3, 2}));
  CHECK(near(at(gresho, {1.1, 2, 5}), {0, 1, 0}));
}
