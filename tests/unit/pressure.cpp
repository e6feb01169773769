// The pressure operator against its algebra: symmetric, positive, with the diagonal that the solver divides by; and a
// solve against the conditions that it promises.
#include <catch2/catch.hpp>
#include <random>

#include "sim/core/parallel.h"
#include "sim/core/passes.h"
#include "sim/sph/pressure.h"

using namespace curlew;

namespace {

// A small disordered heap of particles against walls.
World disordered_world(bool periodic = false) {
  Scene scene;
  scene.particle_radius = 0.025;
  scene.domain.max = {0.6, 0.6, 0.6};
  scene.domain.periodic = {periodic, periodic, periodic};
  scene.fluid.push_back({Box{{0, 0, 0}, periodic ? Vec3d{0.6, 0.6, 0.6} : Vec3d{0.4, 0.4, 0.4}}, {}});
  if (periodic) scene.gravity = {};
  World world = make_world(scene);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> jitter(-0.008f, 0.008f), speed(-1, 1);
  for (std::size_t i = 0; i < world.count; ++i) {
    world.fields.position[i] += Vec3{jitter(random), jitter(random), jitter(random)};
    world.fields.velocity[i] = {speed(random), speed(random), speed(random)};
  }
  return world;
}

}  // namespace

TEST_CASE("the density solve leaves the predicted density within tolerance", "[pressure]") {
  World world = disordered_world();
  world.scene.parameters.pressure.max_iterations = 2000;
  const Plan plan = make_plan(world);
  prepare(world, plan);
  world.dt = 1e-3;
  density_solve(world);
  CHECK(world.report.density_error_avg <= world.parameters().pressure.density_tolerance);
  CHECK(world.report.pressure_iterations > 1);
  for (float k : world.fields.density_stiffness) REQUIRE(k >= 0);
}

TEST_CASE("the divergence solve leaves no compression beyond its tolerance", "[pressure]") {
  World world = disordered_world();
  const Plan plan = make_plan(world);
  prepare(world, plan);
  world.dt = 1e-3;
  const auto speed_before =
      particle_sum(world.count, [&](std::size_t i) { return double{length(world.fields.velocity[i])}; });
  divergence_solve(world);
  CHECK(world.report.divergence_error <= world.parameters().pressure.divergence_tolerance);
  const auto speed_after =
      particle_sum(world.count, [&](std::size_t i) { return double{length(world.fields.velocity[i])}; });
  CHECK(speed_after < speed_before);  // a projection takes energy
}

TEST_CASE("pressure forces keep momentum in a periodic box", "[pressure]") {
  World world = disordered_world(true);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  world.dt = 1e-3;
  const auto momentum = [&](int axis) {
    return particle_sum(world.count, [&](std::size_t i) { return double{world.fields.velocity[i][axis]}; });
  };
  const double before[] = {momentum(0), momentum(1), momentum(2)};
  density_solve(world);
  const double scale =
      particle_sum(world.count, [&](std::size_t i) { return double{length(world.fields.velocity[i])}; });
  for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(momentum(axis) - before[axis]) < 1e-6 * scale);
}

TEST_CASE("one relaxed Jacobi step moves each stiffness by residual over diagonal", "[pressure]") {
  // A single particle on a wall, pushed into it: the solve is one equation in one unknown, diagonal k = source.
  Scene scene;
  scene.particle_radius = 0.025;
  scene.domain.max = {1, 1, 1};
  scene.fluid.push_back({Box{{0, 0, 0}, {0.4, 0.4, 0.4}}, {}});
  scene.parameters.pressure.solver = PressureParameters::solver_t::jacobi;
  scene.parameters.pressure.warm_start = false;
  scene.parameters.pressure.density_tolerance = 1e-7;
  World world = make_world(scene);
  world.count = 1;
  for_each_field(world.fields, [](const FieldRow& row, auto& array) {
    if (row.kind == FieldKind::kept) array.resize(1);
  });
  world.fields.position[0] = {0.5f, 0.001f, 0.5f};
  world.fields.velocity[0] = {0, -30, 0};
  const Plan plan = make_plan(world);
  prepare(world, plan);
  world.dt = 1e-3;
  const double gradient = double{length(world.fields.boundary_gradient[0])};
  const double excess = double{world.fields.density[0]} - 1000 + world.dt * 30 * gradient;
  REQUIRE(excess > 0);
  density_solve(world);
  CHECK(world.fields.density_stiffness[0] ==
        Approx(excess / (world.dt * world.dt) / (gradient * gradient)).epsilon(1e-3));
  CHECK(world.fields.diagonal[0] == Approx(gradient * gradient).epsilon(1e-4));
  // What is left compresses to rest density and no farther.
  CHECK(world.fields.velocity[0].y == Approx(-30 + excess / (world.dt * gradient)).epsilon(1e-3));
}

TEST_CASE("both iterations find the same pressure", "[pressure]") {
  std::vector<double> total;
  for (auto solver : {PressureParameters::solver_t::jacobi, PressureParameters::solver_t::accelerated}) {
    World world = disordered_world();
    world.scene.parameters.pressure.solver = solver;
    world.scene.parameters.pressure.density_tolerance = 1e-7;
    world.scene.parameters.pressure.max_iterations = 20000;
    const Plan plan = make_plan(world);
    prepare(world, plan);
    world.dt = 1e-3;
    density_solve(world);
    CHECK(world.report.limit_hits == 0);
    total.push_back(
        particle_sum(world.count, [&](std::size_t i) { return double{world.fields.density_stiffness[i]}; }));
  }
  CHECK(total[0] == Approx(total[1]).epsilon(0.01));
}

TEST_CASE("in a filled box the divergence solve is a projection", "[pressure]") {
  const bool walls = GENERATE(false, true);
  World world = disordered_world(true);
  if (walls) {
    world.scene.domain.periodic = {false, false, false};
    world = make_world(world.scene);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> jitter(-0.008f, 0.008f), speed(-1, 1);
    for (std::size_t i = 0; i < world.count; ++i) {
      world.fields.position[i] += Vec3{jitter(random), jitter(random), jitter(random)};
      world.fields.velocity[i] = {speed(random), speed(random), speed(random)};
    }
  }
  PressureParameters& p = world.scene.parameters.pressure;
  p.two_sided = true;
  p.divergence_tolerance = 1e-7;
  p.relative_tolerance = 1e-5;
  p.max_divergence_iterations = 2000;
  prepare(world, make_plan(world));
  world.dt = 0.02;
  const auto velocity = world.fields.velocity;
  divergence_solve(world);
  CHECK(world.report.limit_hits == 0);
  // What was taken stands at right angles on what is left.
  double before = 0, after = 0, taken = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3 v = world.fields.velocity[i], change = v - velocity[i];
    before += dot(velocity[i], velocity[i]), after += dot(v, v), taken += dot(change, change);
  }
  INFO("before " << before << ", after " << after << ", taken " << taken);
  CHECK(taken > 0.2 * before);
  CHECK(after + taken == Approx(before).epsilon(1e-4));
  // And there is nothing more to take.
  const auto projected = world.fields.velocity;
  std::fill(world.fields.divergence_stiffness.begin(), world.fields.divergence_stiffness.end(), 0.0f);
  divergence_solve(world);
  double again = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3 change = world.fields.velocity[i] - projected[i];
    again += dot(change, change);
  }
  CHECK(again < 1e-6 * taken);
}

TEST_CASE("the projection ends at the share of compression that is asked for", "[pressure]") {
  int last = 0;
  for (const double share : {0.5, 0.2, 0.05}) {
    World world = disordered_world(true);
    PressureParameters& p = world.scene.parameters.pressure;
    p.two_sided = true;
    p.divergence_tolerance = 1;
    p.relative_tolerance = share;
    prepare(world, make_plan(world));
    world.dt = 1e-3;
    const double given = divergence_error(world);
    divergence_solve(world);
    // Particles at holes, which have no part, count as well.
    CHECK(divergence_error(world) < 1.1 * share * given);
    CHECK(world.report.divergence_iterations > last);
    last = world.report.divergence_iterations;
  }
}
