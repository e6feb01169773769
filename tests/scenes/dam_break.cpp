// The dam break: a 1 m cube of water collapses in a box of 2 m by 2 m by 1 m.
#include <catch2/catch.hpp>

#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

Scene dam_break(int particles_per_metre) { return at_particles_per_metre(bundled("dam_break"), particles_per_metre); }

void check_incompressible(const Run& run) {
  const PressureParameters& p = run.world.parameters().pressure;
  CHECK(p.density_tolerance == 1e-4);
  CHECK(p.divergence_tolerance == 1e-3);
  CHECK(run.share_of_steps([](const Moment& m) { return m.report.density_error_avg <= 1e-4; }) >= 0.99);
  CHECK(run.share_of_steps([](const Moment& m) { return m.report.divergence_error <= 1e-3; }) >= 0.99);
  CHECK(run.mean([](const Moment& m) { return m.report.density_error_true_avg; }) <= 1e-3);
  CHECK(run.largest([](const Moment& m) { return m.report.limit_hits; }) == 0);
}

void check_collapse(const Run& run) {
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
  CHECK(run.energy_rise(0.5) <= 1e-3);
  // Something happened: the water has run down and reached the other end.
  const auto& start = run.history().front().sums;
  CHECK(run.now().sums.potential < 0.8 * start.potential);
  CHECK(run.now().sums.max_speed > 1);
  double front = 0;
  for (const Vec3d& x : positions_by_id(run.world)) front = std::max(front, x.x);
  CHECK(front > 1.9);
}

}  // namespace

TEST_CASE("a dam break stays incompressible, inside the box, and gains no energy", "[scene]") {
  Run run(dam_break(16));
  CHECK(run.world.count == 16 * 16 * 16);
  run.simulate(1);
  check_incompressible(run);
  check_collapse(run);
}

// With so few particles the impact on the far wall counts: what the density solve pushes apart keeps its speed.
TEST_CASE("a dam break gains little energy at smaller steps and with Jacobi iteration", "[scene]") {
  Scene scene = dam_break(16);
  SECTION("a third of the time step") { scene.parameters.time.cfl = 0.1; }
  SECTION("Jacobi iteration") { scene.parameters.pressure.solver = PressureParameters::solver_t::jacobi; }
  Run run(scene);
  run.simulate(1);
  CHECK(run.energy_rise(0.5) <= 6e-3);
  CHECK_NOFAIL(run.energy_rise(0.5) <= 1e-3);  // the aim
}

// A fixed tolerance on the density lets gravity pass in steps as short as these: at 0.25 ms there were 12 % of energy
// from nowhere after 0.1 s, at 0.125 ms the water flew apart.
TEST_CASE("a dam that begins to break has the same energy at any short step") {
  Scene scene = empty_box({0.5, 0.7, 0.5}, 30);
  scene.fluid.push_back(moving(Box{{0, 0, 0}, {0.25, 0.4, 0.5}}, {}));
  const auto energy = [&](double dt) {
    scene.parameters.time.fixed_step = dt;
    Run run(scene);
    run.simulate(0.1);
    return run.now().sums.kinetic + run.now().sums.potential;
  };
  const double usual = energy(2e-3);
  for (const double dt : {5e-4, 2.5e-4, 1.25e-4, 3e-5}) {
    CAPTURE(dt);
    CHECK(energy(dt) == Approx(usual).epsilon(3e-3));
  }
}

// There round-off decides how much the impact gives: tolerances that differ by a thousandth, and two compilers, give
// 0.1 to 0.7 %. So the bound holds for the mean of several runs; none has more energy than at the start.
TEST_CASE("a dam break gains little energy at a hundredth of the divergence tolerance", "[scene]") {
  double mean = 0;
  constexpr double tolerances[] = {0.996e-5, 0.998e-5, 1e-5, 1.003e-5};
  for (const double tolerance : tolerances) {
    Scene scene = dam_break(16);
    scene.parameters.pressure.divergence_tolerance = tolerance;
    Run run(scene);
    run.simulate(1);
    const double rise = run.energy_rise(0.5);
    CAPTURE(tolerance, rise);
    mean += rise / static_cast<double>(std::size(tolerances));
    const double start = run.history().front().sums.mechanical();
    CHECK(run.largest([](const Moment& m) { return m.sums.mechanical(); }) <= start * (1 + 1e-6));
  }
  CHECK(mean <= 6e-3);
  CHECK_NOFAIL(mean <= 1e-3);  // the aim
}

TEST_CASE("a dam break with 24k particles stays incompressible and gains no energy", "[scene][slow]") {
  Run run(bundled("dam_break"));
  CHECK(run.world.count == 29 * 29 * 29);
  run.simulate(1);
  check_incompressible(run);
  check_collapse(run);
}

TEST_CASE("a dam break with 24k particles gains no energy in 10 s", "[scene][slow]") {
  Run run(bundled("dam_break"));
  run.simulate(10);
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
  CHECK(run.energy_rise(0.5) <= 1e-3);
  CHECK(run.largest([](const Moment& m) { return m.report.limit_hits; }) == 0);
}
