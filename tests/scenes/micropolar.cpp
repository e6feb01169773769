// The micropolar model on periodic shear waves, whose growth is known on paper.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/measure/state_hash.h"
#include "sim/sph/motion.h"
#include "sim/turbulence/micropolar_bender2018.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

// Water on a lattice in a periodic square of 1 m, at rest.
Scene still_square() {
  Scene scene = at_particles_per_metre(bundled("taylor_green"), 64);
  scene.fluid[0].jitter = 0;
  scene.parameters.viscosity.nu = 0;
  scene.parameters.micropolar.eta = 0;
  scene.parameters.energy.guard = false;
  scene.parameters.time.fixed_step = 5e-4;
  return scene;
}

// v_x = V sin(k y), omega_z = -W cos(k y).
struct Wave {
  double flow = 0, spin = 0;
};

void set_wave(World& world, double k, Wave wave) {
  world.fields.microrotation.resize(world.count);
  for (std::size_t i = 0; i < world.count; ++i) {
    const double y = double{world.fields.position[i].y};
    world.fields.velocity[i] = to_float({wave.flow * std::sin(k * y), 0, 0});
    world.fields.microrotation[i] = to_float({0, 0, -wave.spin * std::cos(k * y)});
  }
}

Wave wave_of(const World& world, double k) {
  Wave wave;
  for (std::size_t i = 0; i < world.count; ++i) {
    const double y = double{world.fields.position[i].y};
    wave.flow += 2 * double{world.fields.velocity[i].x} * std::sin(k * y) / static_cast<double>(world.count);
    wave.spin -= 2 * double{world.fields.microrotation[i].z} * std::cos(k * y) / static_cast<double>(world.count);
  }
  return wave;
}

// What the sums over neighbours make of k: the curl of a wave on this lattice over its amplitude.
double seen_wave_number(const Scene& scene, double k) {
  World world = make_world(scene);
  const Plan plan = make_plan(world, {FieldId::vorticity});
  set_wave(world, k, {1, 0});
  prepare(world, plan);
  double curl = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    curl -= 2 * double{world.fields.vorticity[i].z} * std::cos(k * double{world.fields.position[i].y}) /
            static_cast<double>(world.count);
  }
  return curl;
}

// The larger eigenvalue (1/s) of d/dt (V, W) = (-nu k^2, c k; c k / Theta, -(zeta k^2 + 2 c) / Theta), c = nu + nu_t.
double growth_rate(const Parameters& p, double c, double k, double exact_k) {
  const double theta = p.micropolar.theta, a = -p.viscosity.nu * exact_k * exact_k;
  const double d = -(p.micropolar.zeta * exact_k * exact_k + 2 * c) / theta, b = c * k, e = c * k / theta;
  return (a + d) / 2 + std::sqrt((a - d) * (a - d) / 4 + b * e);
}

}  // namespace

TEST_CASE("shear waves grow and decay as the eigenvalues of the model say", "[micropolar]") {
  const double spacings = GENERATE(16.0, 32.0);
  Scene scene = still_square();
  Parameters& p = scene.parameters;
  double c = 0;
  SECTION("inviscid: energy is fed in") { c = p.micropolar.nu_t = 0.4; }
  SECTION("full, with viscosity and diffusion of the spin") {
    p.micropolar.model = MicropolarParameters::model_t::full;
    p.viscosity.nu = 0.05;
    p.micropolar.zeta = 0.02;
    p.micropolar.nu_t = 0.1;
    c = 0.15;
  }
  SECTION("full, with a small microinertia") {
    p.micropolar.model = MicropolarParameters::model_t::full;
    p.micropolar.theta = 1e-3;
    p.viscosity.nu = 0.02;
    p.micropolar.nu_t = -0.015;
    c = 0.005;
  }
  const double k = 2 * std::numbers::pi * 64 / spacings, seen = seen_wave_number(scene, k);
  CHECK(seen == Approx(k).epsilon(0.04));
  const double rate = growth_rate(p, c, seen, k);
  // Along the eigenvector of that eigenvalue, so slowly that particles stay on their lattice.
  World world = make_world(scene);
  set_wave(world, k, {1e-3, 1e-3 * (rate + p.viscosity.nu * k * k) / (c * seen)});
  Run run(std::move(world));
  run.simulate(0.2);
  const double measured = std::log(wave_of(run.world, k).flow / 1e-3) / run.world.time;
  INFO("rate " << rate << " 1/s, measured " << measured);
  CHECK(measured == Approx(rate).epsilon(0.02));
}

TEST_CASE("a stiff spin relaxes without a swing", "[micropolar]") {
  Scene scene = still_square();
  scene.parameters.micropolar.nu_t = 10;
  scene.parameters.micropolar.theta = scene.spacing() * scene.spacing();
  World world = make_world(scene);
  set_wave(world, 0, {0, -1});
  Run run(std::move(world));
  for (int k = 0; k < 5; ++k) {
    run.take_steps(1);
    for (const Vec3& omega : run.world.fields.microrotation) {
      const bool settles = omega.z >= 0 && omega.z <= 1e-6f;
      if (!settles) FAIL("omega = " << omega.z << " after step " << k + 1);
    }
  }
  CHECK(run.now().sums.kinetic < 1e-12);
}

TEST_CASE("the full model with nu_t = -nu is the fluid without spin, to the bit", "[micropolar]") {
  Scene scene = at_particles_per_metre(bundled("taylor_green"), 32);
  scene.parameters.viscosity.nu = 0.01;
  Run plain(scene);
  scene.parameters.micropolar.model = MicropolarParameters::model_t::full;
  scene.parameters.micropolar.nu_t = -0.01;
  Run zeroed(scene);
  plain.take_steps(30);
  zeroed.take_steps(30);
  CHECK(state_hash(plain.world.fields) == state_hash(zeroed.world.fields));
  CHECK(zeroed.world.fields.microrotation.empty());
}

TEST_CASE("the model changes the flow within ten steps, and spins carry energy", "[micropolar]") {
  Scene scene = at_particles_per_metre(bundled("taylor_green"), 32);
  Run plain(scene);
  scene.parameters.energy.guard = false;  // ten steps with conserving pressure lose nothing that it would let them give
  scene.parameters.micropolar.nu_t = 0.2;
  Run spinning(scene);
  plain.take_steps(10);
  spinning.take_steps(10);
  CHECK(plain.now().sums.rotational == 0);
  CHECK(spinning.now().sums.rotational > 0);
  CHECK(std::abs(spinning.now().sums.kinetic / plain.now().sums.kinetic - 1) > 1e-6);
}

TEST_CASE("smoothing spins keeps their sum and takes their energy", "[micropolar]") {
  Scene scene = still_square();
  scene.parameters.micropolar.nu_t = 1e-9;
  scene.parameters.micropolar.eta = 0.125;
  scene.parameters.micropolar.xsph_form = MicropolarParameters::xsph_form_t::step;
  scene.parameters.pressure.shifting = 0;  // particles that are shifted take on the spin of their new places
  World world = make_world(scene);
  set_wave(world, 2 * std::numbers::pi * 8, {0, 1});
  for (Vec3& omega : world.fields.microrotation) omega.z += 0.5f;
  const auto sum = [](const World& w) {
    double all = 0;
    for (const Vec3& omega : w.fields.microrotation) all += double{omega.z};
    return all / static_cast<double>(w.count);
  };
  Run run(jittered(std::move(world), 0.2));
  const double before = run.now().sums.rotational, mean = sum(run.world);
  run.take_steps(20);
  CHECK(run.now().sums.rotational < 0.98 * before);
  CHECK(sum(run.world) == Approx(mean).epsilon(1e-4));
}

TEST_CASE("a slip wall leaves spinning water at rest, a no-slip wall drags at it", "[micropolar]") {
  for (const WallKind kind : {WallKind::slip, WallKind::no_slip}) {
    Scene scene = empty_box({0.4, 0.4, 0}, 50);
    for (Wall& wall : scene.domain.walls) wall.kind = kind;
    scene.gravity = {};
    scene.fluid = {moving(Box{{0, 0, 0}, scene.domain.max}, {})};
    scene.parameters.micropolar.nu_t = 0.1;
    World world = make_world(scene);
    prepare(world, make_plan(world));
    for (std::size_t i = 0; i < world.count; ++i) {
      world.fields.microrotation[i] = {0, 0, 2};
      world.fields.acceleration[i] = {};
    }
    couple_spin_and_flow(world);
    for (std::size_t i = 0; i < world.count; ++i) {
      const Vec3 x = world.fields.position[i], a = world.fields.acceleration[i];
      const bool at_floor = x.y < 0.02f && x.x > 0.1f && x.x < 0.3f;
      if (kind == WallKind::slip) CHECK(length(a) < 1e-3f);
      // The spin falls from 2 to none within half a spacing of the floor: the curl of it points along the floor.
      if (kind == WallKind::no_slip && at_floor) CHECK(a.x > 1);
    }
  }
}
