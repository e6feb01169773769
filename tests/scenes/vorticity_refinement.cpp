// Vorticity refinement on losses that are known, and on flows that are.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/measure/state_hash.h"
#include "sim/turbulence/vorticity_refinement_liu2020.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

using Reconstruction = VorticityRefinementParameters::reconstruction_t;

// Water at rest on a periodic lattice, 96 spacings high and 1 mm apart.
Scene tall_lattice(int dimension, Reconstruction reconstruction) {
  Scene scene = empty_box({0.012, 0.096, dimension == 3 ? 0.012 : 0}, 1000);
  scene.domain.periodic = {true, true, dimension == 3};
  scene.gravity = {};
  scene.fluid = {moving(Box{{0, 0, 0}, scene.domain.max}, {})};
  scene.parameters.vorticity_refinement.alpha = 1;
  scene.parameters.vorticity_refinement.reconstruction = reconstruction;
  return scene;
}

// The share of a lost velocity v_x = sin(k y) that refinement brings back.
double response(const Scene& scene, double wave_length) {
  const double k = 2 * std::numbers::pi / wave_length;
  World world = make_world(scene);
  for (std::size_t i = 0; i < world.count; ++i) {
    world.fields.velocity[i] = to_float({std::sin(k * double{world.fields.position[i].y}), 0, 0});
  }
  prepare(world, make_plan(world));
  world.dt = 0;
  predict_vorticity(world);
  std::fill(world.fields.velocity.begin(), world.fields.velocity.end(), Vec3{});
  refine_vorticity(world);
  double back = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    back += 2 * double{world.fields.velocity[i].x} * std::sin(k * double{world.fields.position[i].y});
  }
  return back / static_cast<double>(world.count);
}

// A dam that has begun to break, and its hash after so many steps more with the parameters changed.
World breaking_dam() {
  Run run(at_particles_per_metre(bundled("dam_break"), 12));
  run.simulate(0.3);
  return std::move(run.world);
}

struct After {
  std::uint64_t hash = 0;
  double kinetic = 0, sweeps = 0;
  std::size_t bytes = 0;
};

After ten_steps(World world, const std::vector<std::pair<std::string, double>>& settings) {
  for (const auto& [key, value] : settings) {
    set_parameter(world.scene.parameters, parameter_row(key), value, "");
  }
  world.work = {};
  Run run(std::move(world));
  run.take_steps(10);
  return {state_hash(run.world.fields), run.now().sums.kinetic, static_cast<double>(run.world.work.sweeps),
          allocated_bytes(run.world)};
}

}  // namespace

TEST_CASE("the paper's sum gives back the share of each wave length that theory says", "[refinement]") {
  // A lattice sum over R = 1.99 d and two curls in the difference form, in Fourier space.
  const double spacings[] = {4, 6, 8, 12, 16, 32};
  const double in_3d[] = {0.565, 0.805, 0.642, 0.361, 0.220, 0.059};
  const double in_2d[] = {0.226, 0.340, 0.273, 0.155, 0.094, 0.026};
  for (int dimension : {2, 3}) {
    const Scene scene = tall_lattice(dimension, Reconstruction::sum);
    for (int k = 0; k < 6; ++k) {
      const double expected = dimension == 3 ? in_3d[k] : in_2d[k], found = response(scene, spacings[k] * 1e-3);
      INFO(dimension << "D, wave length " << spacings[k] << " d: " << found);
      CHECK(std::abs(found - expected) < 0.02);
    }
  }
}

TEST_CASE("the solve on a grid gives back waves of 6 spacings and more, and never too much", "[refinement]") {
  for (int dimension : {2, 3}) {
    const Scene scene = tall_lattice(dimension, Reconstruction::poisson);
    for (double spacings : {2.0, 3.0, 4.0, 4.8, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0}) {
      const double found = response(scene, spacings * 1e-3);
      INFO(dimension << "D, wave length " << spacings << " d: " << found);
      CHECK(found < 1.02);
      if (spacings >= 6) CHECK(found > 0.85);
    }
  }
}

TEST_CASE("waves in any direction come back, and walls are mirrors", "[refinement]") {
  // A vortex sheet of cells between slip walls, v = (sin x cos y, -cos x sin y): its images are the flow itself.
  Scene scene = empty_box({0.048, 0.048, 0}, 1000);
  scene.gravity = {};
  scene.fluid = {moving(Box{{0, 0, 0}, scene.domain.max}, {})};
  scene.parameters.vorticity_refinement.alpha = 1;
  World world = make_world(scene);
  const double k = std::numbers::pi / 0.048;
  const auto exact = [&](Vec3 x) {
    return Vec3d{std::sin(k * double{x.x}) * std::cos(k * double{x.y}),
                 -std::cos(k * double{x.x}) * std::sin(k * double{x.y}), 0};
  };
  for (std::size_t i = 0; i < world.count; ++i) {
    world.fields.velocity[i] = to_float(exact(world.fields.position[i]));
  }
  prepare(world, make_plan(world));
  world.dt = 0;
  predict_vorticity(world);
  std::fill(world.fields.velocity.begin(), world.fields.velocity.end(), Vec3{});
  refine_vorticity(world);
  double error = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    error = std::max(error, length(to_double(world.fields.velocity[i]) - exact(world.fields.position[i])));
  }
  CHECK(error < 0.03);
}

TEST_CASE("each turbulence model changes the flow within ten steps, and off none does", "[refinement]") {
  const World start = breaking_dam();
  const After plain = ten_steps(start, {});
  for (const auto& [key, value] : {std::pair<std::string, double>("vorticity_refinement.alpha", 1),
                                   {"micropolar.nu_t", 0.05},
                                   {"vorticity_confinement.epsilon", 0.1}}) {
    INFO(key);
    const After on = ten_steps(start, {{key, value}}), off = ten_steps(start, {{key, 0}});
    CHECK(std::abs(on.kinetic / plain.kinetic - 1) > 1e-7);
    CHECK(on.bytes > plain.bytes);
    CHECK(off.hash == plain.hash);
    CHECK(off.sweeps == plain.sweeps);
    CHECK(off.bytes == plain.bytes);
  }
  const std::vector<std::pair<std::string, double>> sum{{"vorticity_refinement.alpha", 1},
                                                        {"vorticity_refinement.reconstruction", 1}};
  CHECK(ten_steps(start, sum).hash != ten_steps(start, {sum[0]}).hash);
}

TEST_CASE("rigid rotation and uniform motion lose nothing, so nothing is added", "[refinement]") {
  Scene scene = empty_box({0.04, 0.04, 0.04}, 500);
  for (Wall& wall : scene.domain.walls) wall.kind = WallKind::open;
  scene.gravity = {};
  scene.fluid = {moving(Sphere{{0.02, 0.02, 0.02}, 0.015}, {})};
  scene.parameters.vorticity_refinement.alpha = 1;
  World world = make_world(scene);
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3 x = world.fields.position[i] - Vec3{0.02f, 0.02f, 0.02f};
    world.fields.velocity[i] = cross(Vec3{1, 2, 3}, x) + Vec3{1, 1, 1};
  }
  prepare(world, make_plan(world));
  world.dt = 0;
  predict_vorticity(world);
  const auto before = world.fields.velocity;
  refine_vorticity(world);
  for (std::size_t i = 0; i < world.count; ++i) CHECK(length(world.fields.velocity[i] - before[i]) < 1e-5f);
  // And where the velocity is linear the curl is exact, up to the surface.
  for (std::size_t i = 0; i < world.count; ++i) {
    if (world.fields.predicted_vorticity[i].w > 0) {
      CHECK(length(world.fields.predicted_vorticity[i] - Vec3{2, 4, 6}) < 1e-3f);
    }
  }
}

TEST_CASE("the largest swirl of a thin domain comes back too", "[refinement]") {
  for (const Vec3d size : {Vec3d{0.192, 0.096, 0.021}, Vec3d{0.192, 0.192, 0.006}, Vec3d{0.08, 0.04, 0}}) {
    Scene scene = empty_box(size, 1000);
    scene.fluid = {moving(Box{{0, 0, 0}, size}, {})};
    const World world = make_world(scene);
    const double kx = std::numbers::pi / size.x, ky = std::numbers::pi / size.y;
    Array<Vec3> vorticity(world.count);
    for (std::size_t i = 0; i < world.count; ++i) {
      const Vec3d x = to_double(world.fields.position[i]);
      vorticity[i] = to_float({0, 0, (kx * kx + ky * ky) * std::sin(kx * x.x) * std::sin(ky * x.y)});
      vorticity[i].w = static_cast<float>(std::pow(scene.spacing(), scene.dimension));
    }
    VectorPotential potential(scene);
    potential.solve(world.fields.position, vorticity);
    double found = 0, whole = 0;
    for (std::size_t i = 0; i < world.count; ++i) {
      const Vec3d x = to_double(world.fields.position[i]);
      const Vec3d exact{ky * std::sin(kx * x.x) * std::cos(ky * x.y), -kx * std::cos(kx * x.x) * std::sin(ky * x.y), 0};
      found += dot(exact, to_double(potential.curl(world.fields.position[i])));
      whole += dot(exact, exact);
    }
    INFO(size.x << " x " << size.y << " x " << size.z);
    CHECK(found / whole == Approx(1).margin(0.02));
  }
}

TEST_CASE("a domain too large for the grid is told, not run out of memory", "[refinement]") {
  Scene scene = empty_box({1, 1, 1}, 1000);
  CHECK_THROWS_WITH(VectorPotential(scene), Catch::Contains("million nodes") && Catch::Contains("or sum"));
}
