// Bodies that move by keyframes: they push water as pistons, tanks and balls do, and keep it out.
#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/core/error.h"
#include "sim/measure/energy_budget.h"
#include "sim/measure/state_hash.h"
#include "sim/scene/reader.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

// From rest to `velocity` (m/s) in `ramp` seconds, evenly on from there; x = v T (u^3 - u^4/2), u = t/T, on the way.
KeyframePath gathering_speed(Vec3d velocity, double ramp) {
  std::vector<Keyframe> keyframes;
  for (int k = 0; k <= 16; ++k) {
    const double u = k / 16.0;
    keyframes.push_back({ramp * u, (ramp * (u * u * u - u * u * u * u / 2)) * velocity});
  }
  for (int k = 1; k <= 4; ++k) keyframes.push_back({ramp + k, (ramp / 2 + k) * velocity});
  return KeyframePath(std::move(keyframes));
}

// The same speed from long before the start.
KeyframePath steady(Vec3d velocity) {
  std::vector<Keyframe> keyframes;
  for (int k = -3; k <= 6; ++k) keyframes.push_back({1.0 * k, (1.0 * k) * velocity});
  return KeyframePath(std::move(keyframes));
}

// Stands for so long, then goes by `way` in a second.
KeyframePath later(double time, Vec3d way) { return KeyframePath({{0, {}}, {time, {}}, {time + 1, way}}); }

Body moving_body(Shape shape, KeyframePath motion, WallKind kind = WallKind::slip) {
  return {"body", std::move(shape), kind, std::move(motion)};
}

double particles_in_bodies(const Run& run) {
  return run.largest([](const Moment& m) { return m.outside; });
}

double limit_hits(const Run& run) {
  return run.largest([](const Moment& m) { return m.report.limit_hits; });
}

Vec3d mean_velocity(const World& world) {
  return (1 / (double{world.mass} * static_cast<double>(world.count))) * diagnose(world).momentum;
}

Vec3d mean_position(const World& world) {
  Vec3d sum;
  for (const Vec3d& x : positions_by_id(world)) sum += x;
  return (1 / static_cast<double>(world.count)) * sum;
}

std::uint64_t hash_on(int threads, const Scene& scene, int steps) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Run run(scene);
  run.take_steps(steps);
  omp_set_num_threads(before);
  return state_hash(run.world.fields);
}

// A ball that is pulled through a small basin, with all that a moving body has a part in.
Scene ball_with_everything(int dimension) {
  Scene scene = empty_box({1, 0.6, dimension == 3 ? 0.5 : 0.0}, dimension == 3 ? 24 : 40);
  scene.fluid.push_back({Box{{0, 0, 0}, {1, 0.375, 0.5}}, {}});
  scene.bodies.push_back(moving_body(Sphere{{0.3, 0.3, dimension == 3 ? 0.25 : 0.0}, 0.1},
                                     KeyframePath({{0.01, {}}, {0.1, {0.05, 0, 0}}, {0.3, {0.3, -0.05, 0}}}),
                                     WallKind::no_slip));
  scene.bodies.push_back({"step", Box{{0.7, -1, -1}, {2, 0.1, 2}}, WallKind::no_slip});
  scene.parameters.viscosity.nu = 0.005;
  scene.parameters.micropolar.nu_t = 0.05;
  scene.parameters.vorticity_refinement.alpha = 1;
  scene.parameters.vorticity_confinement.epsilon = 0.02;
  return scene;
}

}  // namespace

TEST_CASE("a column of water rises with the piston under it", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  const double speed = 0.5, top = 0.4;
  Scene scene = empty_box({0.4, 1.6, dimension == 3 ? 0.4 : 0.0}, dimension == 3 ? 20 : 40);
  scene.fluid.push_back({Box{{0, top, 0}, {0.4, top + 0.6, 0.4}}, {}});
  scene.parameters.viscosity.nu = 0.01;
  scene.bodies.push_back(moving_body(Box{{-1, -1, -1}, {2, top, 2}}, gathering_speed({0, speed, 0}, 0.3)));
  Run run(scene);
  const double start = mean_position(run.world).y;
  run.simulate(0.35);
  CHECK(run.now().sums.momentum.y / (double{run.world.mass} * static_cast<double>(run.world.count)) ==
        Approx(speed).epsilon(0.05));
  run.simulate(0.65);
  const BodyPlace piston = run.world.body_places[0];
  CHECK(piston.velocity.y == Approx(speed).epsilon(1e-3));
  CHECK(piston.offset.y == Approx(speed * (run.world.time - 0.15)).epsilon(1e-3));
  CHECK(mean_velocity(run.world).y == Approx(speed).epsilon(0.05));
  // The water has settled onto the samples by a part of a spacing, and is as high as before.
  CHECK(mean_position(run.world).y - start - piston.offset.y <= 0);
  CHECK(mean_position(run.world).y - start - piston.offset.y >= -0.2 * scene.spacing());
  CHECK(particles_in_bodies(run) == 0);
  CHECK(limit_hits(run) == 0);
  CHECK(run.largest([](const Moment& m) { return m.report.density_error_true_avg; }) < 2e-3);
}

TEST_CASE("a piston gives a plug of water that floats free its speed", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  const double speed = 0.5;
  Scene scene = empty_box({1.5, 0.4, dimension == 3 ? 0.4 : 0.0}, dimension == 3 ? 20 : 40);
  scene.gravity = {};
  scene.fluid.push_back({Box{{0.3, 0, 0}, {0.9, 0.4, 0.4}}, {}});
  scene.parameters.viscosity.nu = 0.01;
  scene.bodies.push_back(moving_body(Box{{0, -1, -1}, {0.3, 2, 2}}, gathering_speed({speed, 0, 0}, 0.5)));
  Run run(scene);
  run.simulate(0.5);
  CHECK(mean_velocity(run.world).x == Approx(speed).epsilon(0.05));
  // Nothing holds it: what the density solve pushed apart, in the layers next to the piston, drifts on.
  run.simulate(0.3);
  CHECK(mean_velocity(run.world).x == Approx(speed).epsilon(0.08));
  CHECK(mean_velocity(run.world).x >= 0.99 * speed);
  CHECK(std::abs(mean_velocity(run.world).y) < 0.01 * speed);
  CHECK(particles_in_bodies(run) == 0);
}

// A tank made of bodies that moves at an even speed with the water in it: seen from the tank, nothing is different.
// (Not with vorticity refinement, whose grid stands still and makes 0.005 spacings of difference.)
TEST_CASE("water breaks in a moving tank as in one at rest", "[scene]") {
  const int dimension = GENERATE(2, 3);
  const bool models = GENERATE(false, true);
  CAPTURE(dimension, models);
  const Vec3d speed{0.7, 0, dimension == 3 ? -0.4 : 0};
  const auto tank = [&](bool moves) {
    Scene scene = empty_box({6, 3, dimension == 3 ? 3.0 : 0.0}, 20);
    scene.parameters.time.fixed_step = 2e-3;
    PressureParameters& pressure = scene.parameters.pressure;
    pressure.density_tolerance = pressure.divergence_tolerance = 1e-7;
    pressure.max_iterations = pressure.max_divergence_iterations = 1000;
    scene.parameters.viscosity.nu = 0.01;
    if (models) {
      scene.parameters.micropolar.nu_t = 0.05;
      scene.parameters.micropolar.gamma = 0.05;
      scene.parameters.vorticity_confinement.epsilon = 0.02;
    }
    scene.fluid.push_back(moving(Box{{1.5, 1, 1.5}, {2, 1.5, 2}}, moves ? speed : Vec3d{}));
    std::vector<Box> sides{
        {{1.3, 0.8, 1.3}, {2.7, 1, 2.2}}, {{1.3, 1, 1.3}, {1.5, 2, 2.2}}, {{2.5, 1, 1.3}, {2.7, 2, 2.2}}};
    if (dimension == 3) {
      sides.push_back({{1.5, 1, 1.3}, {2.5, 2, 1.5}});
      sides.push_back({{1.5, 1, 2}, {2.5, 2, 2.2}});
    }
    for (const Box& side : sides) {
      scene.bodies.push_back(moving_body(side, moves ? steady(speed) : KeyframePath(), WallKind::no_slip));
    }
    return scene;
  };
  Run rest(tank(false)), moved(tank(true));
  rest.simulate(0.1);
  moved.simulate(0.1);
  const auto expected = positions_by_id(rest.world), found = positions_by_id(moved.world);
  double farthest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    farthest = std::max(farthest, length(found[i] - moved.world.time * speed - expected[i]));
  }
  CHECK(farthest <= 5e-4 * moved.world.scene.spacing());
  CHECK(rms_speed(rest.world) > 0.5);
}

TEST_CASE("a ball pulled through a full box keeps water out", "[scene]") {
  Scene scene = empty_box({1.2, 0.6, 0.6}, 20);
  scene.gravity = {};
  scene.fluid.push_back({Box{{0, 0, 0}, {1.2, 0.6, 0.6}}, {}});
  scene.bodies.push_back(
      moving_body(Sphere{{0.3, 0.3, 0.3}, 0.15},
                  KeyframePath({{0, {}}, {0.2, {0.1, 0, 0}}, {0.5, {0.4, 0, 0}}, {0.8, {0.6, 0, 0}}})));
  Run run(scene);
  run.simulate(0.9);
  CHECK(particles_in_bodies(run) == 0);
  CHECK(run.largest([](const Moment& m) { return m.report.density_error_true_avg; }) < 5e-3);
  CHECK(run.largest([](const Moment& m) { return m.report.max_speed; }) < 5);
  // Its samples went with it.
  for (const Vec3& x : run.world.bodies.position()) CHECK(length(to_double(x) - Vec3d{0.9, 0.3, 0.3}) < 0.15);
}

// Where water fills a box, its mass moves back as the ball's volume goes forth: P = -rho V_ball U, exactly. The energy
// is that of the added mass, in 2D all and in 3D half of the displaced water (Lamb 1932, art. 68, 92), and some more
// for near walls and for the wake.
TEST_CASE("a ball that starts sets the water around it in motion as in potential flow", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  const double radius = 0.16, speed = 0.2, pi = std::numbers::pi;
  const double depth = dimension == 3 ? 0.8 : 0;
  Scene scene = empty_box({1.2, 0.8, depth}, dimension == 3 ? 25 : 50);
  scene.gravity = {};
  scene.fluid.push_back({Box{{0, 0, 0}, {1.2, 0.8, depth}}, {}});
  scene.bodies.push_back(moving_body(Sphere{{0.5, 0.4, depth / 2}, radius}, gathering_speed({speed, 0, 0}, 0.2)));
  scene.parameters.pressure.two_sided = true;
  scene.parameters.pressure.divergence_tolerance = 1e-6;
  Run run(scene);
  run.simulate(0.3);  // it has closed what the lattice had left free around it
  const double water = (dimension == 3 ? 4 * pi / 3 * radius : pi) * radius * radius * 1000;
  const double ball_energy = water * speed * speed / 2, added = dimension == 3 ? 0.5 : 1;
  const Diagnostics sums = run.now().sums;
  CHECK(sums.momentum.x == Approx(-water * speed).epsilon(0.15));
  CHECK(std::abs(sums.momentum.y) < 0.05 * water * speed);
  CHECK(std::abs(sums.momentum.z) < 0.05 * water * speed);
  CHECK(sums.kinetic > 0.9 * added * ball_energy);
  CHECK(sums.kinetic < 2 * added * ball_energy);
  CHECK(particles_in_bodies(run) == 0);
}

TEST_CASE("a body that has yet to move gives the same bits as one at rest", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  Scene scene = ball_with_everything(dimension);
  scene.bodies.resize(1);
  scene.bodies[0].motion = KeyframePath();
  const std::uint64_t at_rest = hash_on(1, scene, 30);
  scene.bodies[0].motion = KeyframePath({{0, {}}, {1, {}}});
  CHECK(hash_on(1, scene, 30) == at_rest);
  scene.bodies[0].motion = later(100, {0.1, 0, 0});
  CHECK(make_world(scene).bodies.any_moving());
  CHECK(hash_on(1, scene, 30) == at_rest);
  scene.bodies[0].motion = later(0, {0.1, 0, 0});
  CHECK(hash_on(1, scene, 30) != at_rest);
}

TEST_CASE("beside a moving body the state does not depend on the number of threads", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  const Scene scene = ball_with_everything(dimension);
  CHECK(hash_on(3, scene, 40) == hash_on(1, scene, 40));
}

// As a checkpoint keeps it: the scene as text, the kept fields, and the numbers.
TEST_CASE("a run with a moving body goes on with the same bits", "[scene]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  Run whole(ball_with_everything(dimension));
  whole.take_steps(40);
  Run first(ball_with_everything(dimension));
  first.take_steps(25);
  const World& left = first.world;
  World resumed = make_empty_world(parse_scene(scene_json(left.scene), "elsewhere.json"), left.seed);
  REQUIRE(resumed.body_places.size() == 2);
  resumed.count = left.count;
  resumed.step = left.step;
  resumed.time = left.time;
  resumed.dt = left.dt;
  resumed.energy = left.energy;
  resumed.start = left.start;
  resumed.fields.position = left.fields.position;
  resumed.fields.velocity = left.fields.velocity;
  resumed.fields.id = left.fields.id;
  resumed.fields.density_stiffness = left.fields.density_stiffness;
  resumed.fields.divergence_stiffness = left.fields.divergence_stiffness;
  resumed.fields.microrotation = left.fields.microrotation;
  resumed.fields.predicted_vorticity = left.fields.predicted_vorticity;
  Run second(std::move(resumed));
  second.take_steps(15);
  CHECK(second.world.time == whole.world.time);
  CHECK(second.world.body_places[0].offset == whole.world.body_places[0].offset);
  CHECK(state_hash(second.world.fields) == state_hash(whole.world.fields));
}

// A block of water without weight on a long plate that moves under it: a boundary layer, whose momentum after a time t
// is 2 rho U sqrt(nu t / pi) for each square metre (Stokes' first problem).
TEST_CASE("a moving no-slip plate drags water along, a slip one does not", "[scene]") {
  const double speed = 0.05, nu = 0.02, time = 0.4;
  const auto dragged = [&](WallKind kind) {
    Scene scene = empty_box({3, 0.6, 0}, 40);
    scene.gravity = {};
    scene.fluid.push_back({Box{{1, 0.1, 0}, {2, 0.6, 0}}, {}});
    scene.parameters.viscosity.nu = nu;
    scene.bodies.push_back(moving_body(Box{{-2, -1, 0}, {5, 0.1, 0}}, steady({speed, 0, 0}), kind));
    Run run(scene);
    run.simulate(time);
    CHECK(particles_in_bodies(run) == 0);
    return run.now().sums.momentum.x;
  };
  const double expected = 2 * 1000 * speed * std::sqrt(nu * time / std::numbers::pi);
  CHECK(dragged(WallKind::no_slip) == Approx(expected).epsilon(0.2));
  CHECK(std::abs(dragged(WallKind::slip)) < 0.05 * expected);
}

TEST_CASE("the time step follows the speed of a body", "[scene]") {
  Scene scene = empty_box({2, 1, 0}, 20);
  scene.gravity = {};
  scene.fluid.push_back({Box{{0, 0, 0}, {0.2, 0.2, 0}}, {}});
  scene.bodies.push_back(moving_body(Sphere{{0.3, 0.8, 0}, 0.1}, KeyframePath({{0.2, {}}, {0.3, {1, 0, 0}}})));
  Run run(scene);
  run.simulate(0.5);
  const TimeParameters& t = scene.parameters.time;
  double fastest = 0;
  for (std::size_t k = 1; k < run.history().size(); ++k) {
    const Moment& m = run.history()[k];
    const double way =
        length(scene.bodies[0].motion.at(m.time).offset - scene.bodies[0].motion.at(m.time - m.dt).offset);
    CHECK(way <= t.cfl * scene.spacing() * (1 + 1e-9));
    fastest = std::max(fastest, way / m.dt);
  }
  CHECK(fastest > 14);  // 15 m/s in the middle
  CHECK(run.now().dt == Approx(t.max_step));
}

TEST_CASE("a body may drive water for ever, and one that has stopped may not", "[scene]") {
  // Water at rest without gravity has no energy at all; what stirs it gives it some.
  Scene scene = empty_box({0.6, 0.6, 0}, 40);
  scene.gravity = {0, -0.01, 0};
  scene.fluid.push_back({Box{{0, 0, 0}, {0.6, 0.4, 0}}, {}});
  scene.bodies.push_back(
      moving_body(Sphere{{0.2, 0.2, 0}, 0.08}, KeyframePath({{0, {}}, {0.1, {0.1, 0, 0}}, {0.3, {0.2, 0, 0}}})));
  Run run(scene);
  const double before = run.now().sums.mechanical();
  run.simulate(0.2);
  CHECK(run.now().sums.mechanical() > 4 * before);
  run.simulate(0.3);
  const double left = run.world.start.energy;
  for (Vec3& v : run.world.fields.velocity) v = 5.0f * v;
  CHECK_THROWS_AS(run.take_steps(2), DivergedError);
  CHECK(run.world.start.energy == left);
}

TEST_CASE("the energy budget knows the work of a piston", "[scene]") {
  const double speed = 0.5;
  Scene scene = empty_box({0.4, 1.6, 0}, 40);
  scene.fluid.push_back({Box{{0, 0.4, 0}, {0.4, 1, 0}}, {}});
  scene.bodies.push_back(moving_body(Box{{-1, -1, 0}, {2, 0.4, 0}}, gathering_speed({0, speed, 0}, 0.3)));
  scene.parameters.viscosity.nu = 0.01;
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  struct Observer : PassObserver {
    explicit Observer(const Plan& plan) : budget(plan) {}
    void after(const Pass& pass, const World& now, double) override { budget.after(pass, now); }
    EnergyBudget budget;
  } observer(plan);
  const double before = diagnose(world).mechanical();
  double work = 0, losses = 0;
  while (world.time < 0.8) {
    observer.budget.begin_step(world);
    step(world, plan, &observer);
    for (const EnergyBudget::Term& term : observer.budget.terms()) {
      if (term.name == "work_bodies") work += term.step;
      if (!term.is_work) losses += term.step;
    }
  }
  // Lifting the weight and setting it in motion; friction with the walls is none.
  const double lifted = diagnose(world).mechanical() - before;
  CHECK(work == Approx(lifted).epsilon(0.03));
  CHECK(std::abs(losses) < 0.1 * work);  // the part that gravity gives within each step
}

// The guard lets the turbulence models give back what the solver has lost. If it took the work of a body for a gain of
// the solves, nothing would be left to give while a body drives the water.
TEST_CASE("the energy guard knows the work of a piston", "[scene]") {
  const double speed = 0.5;
  Scene scene = empty_box({0.4, 1.6, 0}, 40);
  scene.fluid.push_back({Box{{0, 0.4, 0}, {0.4, 1, 0}}, {}});
  scene.bodies.push_back(moving_body(Box{{-1, -1, 0}, {2, 0.4, 0}}, gathering_speed({0, speed, 0}, 0.3)));
  scene.parameters.vorticity_confinement.epsilon = 0.01;
  Run run(scene);
  double work = 0, lowest = 0;
  while (run.world.time < 0.8) {
    run.take_steps(1);
    work += run.now().report.body_work;
    lowest = std::min(lowest, run.world.energy.reserve);
  }
  CHECK(work > 500);
  CHECK(lowest > -0.01 * work);
  CHECK(run.world.energy.reserve > 0);
}
