// Probes against known answers: linear fields, hydrostatic pressure, the height of a filled box.
#include "sim/measure/probes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/core/passes.h"

using namespace curlew;

namespace {

using Quantity = Probe::Quantity;

constexpr double d = 0.05;  // spacing, m

// A box of 1 m, filled up to `height`.
Scene tank(int dimension, double height) {
  Scene scene;
  scene.dimension = dimension;
  scene.particle_radius = d / 2;
  scene.domain.max = {1, 1, dimension == 3 ? 1.0 : 0.0};
  scene.fluid.push_back({Box{{0, 0, 0}, {1, height, scene.domain.max.z}}, {}});
  return scene;
}

// The world as between two steps, with fields as functions of the place.
template <class Velocity, class Pressure>
World world_with(const Scene& scene, Velocity&& velocity, Pressure&& pressure) {
  World world = make_world(scene);
  prepare(world, make_plan(world, {FieldId::pressure}));
  world.step = 1;
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3d x = to_double(world.fields.position[i]);
    world.fields.velocity[i] = to_float(velocity(x));
    world.fields.pressure[i] = static_cast<float>(pressure(x));
  }
  return world;
}

World at_rest(const Scene& scene) {
  return world_with(
      scene, [](Vec3d) { return Vec3d{}; }, [](Vec3d) { return 0.0; });
}

Probe point(Quantity quantity, Vec3d at) { return {"p", quantity, at, at, 1, 0}; }

double value(const World& world, Quantity quantity, Vec3d at) {
  const auto values = measure(world, point(quantity, at));
  REQUIRE(values.size() == 1);
  REQUIRE(values[0].has_value());
  return *values[0];
}

double height(const World& world, Vec3d at) { return value(world, Quantity::water_height, at); }

// Where the mean over a lattice that touches a wall looks, in spacings from the wall (3D 0.525, 2D 0.533).
constexpr double depth = 0.53;

}  // namespace

TEST_CASE("a linear velocity is found inside, and at walls as it is half a spacing in", "[probes]") {
  const int dimension = GENERATE(2, 3);
  const auto velocity = [&](Vec3d x) {
    return Vec3d{1 + 2 * x.x - 3 * x.y, 0.5 - x.x + x.y + 4 * x.z, dimension == 3 ? x.x - 2 * x.z : 0};
  };
  const World world = world_with(tank(dimension, 0.5), velocity, [](Vec3d) { return 0.0; });
  const double middle = dimension == 3 ? 0.5 : 0, in = depth * d;
  struct Place {
    Vec3d at, seen;
    double margin;
  };
  const std::vector<Place> places{
      {{0.5, 0.25, middle}, {0.5, 0.25, middle}, 1e-5},  // between particles
      {{0.525, 0.225, middle}, {0.525, 0.225, middle}, 1e-5}, {{0.31, 0.22, middle}, {0.31, 0.22, middle}, 0.01},
      {{0.5, 0, middle}, {0.5, in, middle}, 0.002},           {{0, 0.25, middle}, {in, 0.25, middle}, 0.002},
      {{1, 0, middle}, {1 - in, in, middle}, 0.002}};
  for (const Place& place : places) {
    INFO(dimension << "D, at " << place.at.x << " " << place.at.y << " " << place.at.z);
    const auto values = measure(world, point(Quantity::velocity, place.at));
    REQUIRE(values.size() == static_cast<std::size_t>(dimension));
    for (int axis = 0; axis < dimension; ++axis) {
      CHECK(values[static_cast<std::size_t>(axis)].value() == Approx(velocity(place.seen)[axis]).margin(place.margin));
    }
  }
}

TEST_CASE("a line of probes finds the hydrostatic profile", "[probes]") {
  const int dimension = GENERATE(2, 3);
  const auto pressure = [](double y) { return 9810 * (0.5 - y); };
  const World world = world_with(
      tank(dimension, 0.5), [](Vec3d) { return Vec3d{}; }, [&](Vec3d x) { return pressure(x.y); });
  const double middle = dimension == 3 ? 0.5 : 0;
  const Probe line{"p", Quantity::pressure, {0.25, 0, middle}, {0.25, 0.5, middle}, 11, 0};
  const auto values = measure(world, line);
  REQUIRE(values.size() == 11);
  CHECK(values[0].value() == Approx(pressure(depth * d)).margin(0.01 * 9810 * d));
  CHECK(values[10].value() == Approx(pressure(0.5 - depth * d)).margin(0.01 * 9810 * d));
  for (int k = 2; k < 9; ++k) CHECK(values[static_cast<std::size_t>(k)].value() == Approx(pressure(0.05 * k)));
}

TEST_CASE("a probe stays within the values of the particles in reach", "[probes]") {
  const World world = world_with(
      tank(3, 0.5), [](Vec3d) { return Vec3d{}; }, [](Vec3d x) { return x.y > 0.45 ? 1.0 : 1e6; });
  CHECK(value(world, Quantity::pressure, {0.5, 0.55, 0.5}) == Approx(1).epsilon(1e-6));  // only the highest layer
  CHECK(value(world, Quantity::pressure, {0.5, 0, 0.5}) == Approx(1e6).epsilon(1e-6));
}

TEST_CASE("probes see across a periodic boundary", "[probes]") {
  Scene scene = tank(2, 1);
  scene.domain.periodic = {true, false, false};
  const auto wave = [](Vec3d x) { return Vec3d{std::cos(2 * std::numbers::pi * x.x), 0, 0}; };
  const World world = world_with(scene, wave, [](Vec3d) { return 0.0; });
  const auto at = [&](double x) { return *measure(world, point(Quantity::velocity, {x, 0.5, 0}))[0]; };
  CHECK(at(0) == Approx(at(1)).epsilon(1e-6));
  CHECK(at(0) == Approx(at(0.5) * -1).epsilon(1e-5));  // at 0.5 nothing is cut off
}

TEST_CASE("the water height of a half-filled box is within a quarter spacing", "[probes]") {
  const int dimension = GENERATE(2, 3);
  const World world = at_rest(tank(dimension, 0.5));
  for (const double x : {0.0, 0.013, 0.5, 0.525, 1.0}) {
    for (const double z : {0.0, 0.49, 1.0}) {
      INFO(dimension << "D, x " << x << ", z " << z);
      CHECK(height(world, {x, 0, dimension == 3 ? z : 0}) == Approx(0.5).margin(d / 4));
    }
  }
}

TEST_CASE("water stands up to the ceiling of a full box, and one layer deep on a floor", "[probes]") {
  CHECK(height(at_rest(tank(3, 1)), {0.5, 0, 0.5}) == 1);
  CHECK(height(at_rest(tank(3, d)), {0.5, 0, 0.5}) == Approx(d).margin(d / 4));
}

TEST_CASE("up is against gravity, from the domain's lowest point", "[probes]") {
  Scene scene = tank(2, 0.5);
  scene.domain.min = {0, -1, 0};
  scene.domain.max = {1, 0.5, 0};
  scene.gravity = {0, 9.81, 0};  // falls up: the fluid lies under the face y+
  CHECK(height(at_rest(scene), {0.5, 0, 0}) == Approx(0.5).margin(d / 4));
  scene.gravity = {-9.81, -1, 0};
  scene.fluid[0].shape = Box{{0, -1, 0}, {0.3, 0.5, 0}};
  CHECK(scene.vertical_axis() == 0);
  CHECK(height(at_rest(scene), {0, 0.2, 0}) == Approx(0.3).margin(d / 4));
  scene.gravity = {};
  CHECK(scene.vertical_axis() == 1);
}

TEST_CASE("the water height holds at the face of a body", "[probes]") {
  Scene scene = tank(3, 0.5);
  scene.bodies.push_back({"pillar", Box{{0.4, 0, 0.4}, {0.6, 1, 0.6}}, WallKind::slip});
  const World world = at_rest(scene);
  CHECK(height(world, {0.39, 0, 0.5}) == Approx(0.5).margin(d / 2));
  CHECK_FALSE(measure(world, point(Quantity::water_height, {0.5, 0, 0.5}))[0].has_value());
}

TEST_CASE("probes are empty where it is dry, and pressure before the first step", "[probes]") {
  Scene scene = tank(3, 0.5);
  scene.fluid[0].shape = Box{{0, 0, 0}, {0.5, 0.5, 1}};
  World world = at_rest(scene);
  for (const Quantity quantity : {Quantity::pressure, Quantity::velocity, Quantity::water_height}) {
    const auto dry = measure(world, point(quantity, {0.7, 0.1, 0.5})),
               wet = measure(world, point(quantity, {0.3, 0.1, 0.5}));
    CHECK(dry.size() == (quantity == Quantity::velocity ? 3 : 1));
    for (const auto& cell : dry) CHECK_FALSE(cell.has_value());
    for (const auto& cell : wet) CHECK(cell.has_value());
  }
  world.step = 0;
  CHECK_FALSE(measure(world, point(Quantity::pressure, {0.3, 0.1, 0.5}))[0].has_value());
  CHECK(measure(world, point(Quantity::velocity, {0.3, 0.1, 0.5}))[0].has_value());
}

TEST_CASE("each value of a probe has a column", "[probes]") {
  using Names = std::vector<std::string>;
  CHECK(probe_columns(point(Quantity::pressure, {}), 3) == Names{"p"});
  CHECK(probe_columns(point(Quantity::velocity, {}), 2) == Names{"p.x", "p.y"});
  const Vec3d end{1, 0, 0};
  CHECK(probe_columns({"u", Quantity::velocity, {}, end, 2, 0}, 3) ==
        Names{"u[0].x", "u[0].y", "u[0].z", "u[1].x", "u[1].y", "u[1].z"});
  CHECK(probe_columns({"h", Quantity::water_height, {}, end, 3, 0}, 2) == Names{"h[0]", "h[1]", "h[2]"});
}

TEST_CASE("only pressure asks the solver for a field", "[probes]") {
  Scene scene = tank(3, 0.5);
  CHECK(probe_fields(scene) == FieldSet{});
  scene.probes = {point(Quantity::velocity, {}), point(Quantity::water_height, {})};
  CHECK(probe_fields(scene) == FieldSet{});
  scene.probes.push_back(point(Quantity::pressure, {}));
  CHECK(probe_fields(scene) == FieldSet{FieldId::pressure});
}
