// The terms of the energy budget, each against what it is on paper or in another account: force times distance,
// enstrophy, an exact field, a prescribed loss. That the terms add up says nothing, since they are differences.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "sim/core/parallel.h"
#include "sim/measure/energy_budget.h"
#include "sim/measure/vortex.h"
#include "sim/sph/velocity_gradient.h"
#include "sim/turbulence/vorticity_refinement_liu2020.h"
#include "sim/turbulence/wavelet_turbulence_fujisawa2011.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

constexpr double pi = std::numbers::pi;

// A run that sums up its budget.
class Account : public PassObserver {
 public:
  World world;
  const Plan plan;

  explicit Account(World start, FieldSet demanded = {})
      : world(std::move(start)), plan(make_plan(world, demanded)), budget_(plan), sums_(budget_.terms().size()) {
    prepare(world, plan);
  }

  void take_step() {
    budget_.begin_step(world);
    step(world, plan, this);
    for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k] += budget_.terms()[k].step;
  }

  // J since the start.
  double sum(std::string_view term) const {
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      if (budget_.terms()[k].name == term) return sums_[k];
    }
    FAIL("there is no term " << term);
    return 0;
  }

  void after(const Pass& pass, const World& now, double) override { budget_.after(pass, now); }

 private:
  EnergyBudget budget_;
  std::vector<double> sums_;
};

double mass_of(const World& world) { return double{world.mass} * static_cast<double>(world.count); }

// Taylor-Green vortices on a lattice that nothing but what a test switches on acts on.
Scene lattice_vortices(int particles_per_metre) {
  Scene scene = at_particles_per_metre(bundled("taylor_green"), particles_per_metre);
  scene.fluid[0].jitter = 0;
  scene.parameters.viscosity.nu = 0;
  scene.parameters.energy.guard = false;
  return scene;
}

// A step from a flow of which the share `cut` of the velocity has just gone missing.
Account after_a_loss(const Scene& scene, double cut) {
  Account account(make_world(scene));
  World& world = account.world;
  const double dt = std::exchange(world.dt, 0.0);
  predict_vorticity(world);
  world.dt = dt;
  for (Vec3& v : world.fields.velocity) v = static_cast<float>(1 - cut) * v;
  account.take_step();
  return account;
}

// How far the work of gravity is from what the potential energy lost, as a share of that, while a dam breaks.
double gravity_splitting_error(double dt) {
  Scene scene = at_particles_per_metre(bundled("dam_break_2d"), 30);
  scene.parameters.time.fixed_step = dt;
  Account account(make_world(scene));
  const double start = diagnose(account.world).potential;
  while (account.world.time < 0.5 - 0.5 * dt) account.take_step();
  const double fallen = start - diagnose(account.world).potential;
  return account.sum("work_gravity") / fallen - 1;
}

// int |curl v|^2 / 2, with curls that are exact for linear flow; plain sums miss some per cent where there is disorder.
double corrected_enstrophy(const World& world) {
  double sum = 0;
  with_images(world.cells, [&](auto images) {
    sum = particle_sum(world.count, [&](std::size_t i) {
      const Vec3 curl = velocity_gradient(world, i, images).curl();
      return 0.5 * double{world.mass / world.fields.density[i]} * dot(curl, curl);
    });
  });
  return sum;
}

}  // namespace

TEST_CASE("what viscosity takes from Taylor-Green vortices is 2 nu times their enstrophy", "[budget]") {
  // rho nu int omega^2 = M nu |k|^2 U^2 / 2 with |k|^2 = 2 (2 pi / L)^2, U: amplitude of the flow that is there.
  const Scene scene = at_particles_per_metre(bundled("taylor_green"), 80);
  InitialVelocity unit = scene.fluid[0].velocity;
  unit.speed = 1;
  Account account(make_world(scene));
  const double nu = scene.parameters.viscosity.nu, k = 2 * pi;
  double by_amplitude = 0, by_curl = 0;
  while (account.world.time < 0.2) {
    const World& world = account.world;
    const double before = flow_amplitude(world, unit), enstrophy_before = corrected_enstrophy(world);
    account.take_step();
    const double amplitude = (before + flow_amplitude(world, unit)) / 2;
    by_amplitude += world.dt * nu * k * k * amplitude * amplitude * mass_of(world);
    by_curl += world.dt * nu * (enstrophy_before + corrected_enstrophy(world)) * double{world.rest_density()};
  }
  const double loss = account.sum("loss_viscosity");
  INFO("loss " << loss << " J, by the amplitude " << by_amplitude << ", by the curl " << by_curl);
  CHECK(loss == Approx(by_amplitude).epsilon(0.02));
  CHECK(loss == Approx(by_curl).epsilon(0.02));
}

TEST_CASE("no-slip walls that move do work: force times distance less what friction takes", "[budget]") {
  // Fluid at rest between walls at y = 0 and 1 m that move at 1 m/s: u = 1 - sum over odd n of 4/(n pi) sin(n pi y)
  // exp(-nu n^2 pi^2 t). Seen from the walls this is plug flow that friction stops.
  const double nu = 0.1;
  Scene scene = empty_box({0.5, 1, 0}, 20);
  scene.gravity = {};
  scene.domain.periodic[0] = true;
  for (int face : {2, 3}) {
    scene.domain.walls[face].kind = WallKind::no_slip;
    scene.domain.walls[face].velocity = {1, 0, 0};
  }
  scene.fluid.push_back(moving(Box{{0, 0, 0}, scene.domain.max}, {}));
  scene.parameters.viscosity.nu = nu;
  Account account(make_world(scene));
  while (account.world.time < 0.5) account.take_step();
  const World& world = account.world;
  double left = 0;  // mean of (u - 1)^2
  for (int n = 1; n < 100; n += 2) left += 8 / (n * n * pi * pi) * std::exp(-2 * nu * n * n * pi * pi * world.time);
  const double friction = mass_of(world) * (1 - left) / 2, work = 1.0 * diagnose(world).momentum.x;
  INFO("work " << work << " J, friction " << friction << " J, in the budget " << -account.sum("loss_viscosity"));
  CHECK(-account.sum("loss_viscosity") == Approx(work - friction).epsilon(0.03));
}

TEST_CASE("potential energy changes by gravity along the particles' ways", "[budget]") {
  const auto [dimension, gravity] = GENERATE(table<int, Vec3d>({
      {2, {0, -9.81, 0}},
      {2, {4, -8, 0}},
      {3, {0, -9.81, 0}},
      {3, {-3, -8, 5}},
  }));
  Scene scene =
      at_particles_per_metre(bundled(dimension == 2 ? "dam_break_2d" : "dam_break"), dimension == 2 ? 30 : 14);
  scene.gravity = gravity;
  CAPTURE(dimension, gravity.x, gravity.y, gravity.z);
  Run run(scene);
  const double start = run.now().sums.potential;
  double work = 0, way = 0;
  while (run.world.time < 0.5) {
    const std::vector<Vec3d> before = positions_by_id(run.world);
    run.take_steps(1);
    const std::vector<Vec3d> after = positions_by_id(run.world);
    REQUIRE(after.size() == before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      const double done = double{run.world.mass} * dot(gravity, after[i] - before[i]);
      work += done;
      way += std::abs(done);
    }
  }
  CHECK(way > 0.1 * start);
  CHECK(start - run.now().sums.potential == Approx(work).epsilon(1e-6));
}

TEST_CASE("potential energy is that of the centre of mass over the lowest corner", "[budget]") {
  Scene scene = empty_box({2, 1, 3}, 20);
  scene.fluid.push_back(moving(Box{{0, 0, 0}, {1, 0.5, 2}}, {}));
  const auto height = [&](Vec3d gravity) {
    scene.gravity = gravity;
    const World world = make_world(scene);
    return diagnose(world).potential / mass_of(world);  // times g: m^2/s^2
  };
  CHECK(height({0, -10, 0}) == Approx(10 * 0.25));
  CHECK(height({0, 10, 0}) == Approx(10 * 0.75));
  CHECK(height({4, -10, -3}) == Approx(4 * (2 - 0.5) + 10 * 0.25 + 3 * 1.0));
}

TEST_CASE("gravity's work is what the potential energy loses, up to a splitting error of first order", "[budget]") {
  const double coarse = gravity_splitting_error(2e-3), fine = gravity_splitting_error(1e-3);
  CAPTURE(coarse, fine);
  CHECK(std::abs(fine) < 0.03);
  CHECK(coarse / fine == Approx(2).epsilon(0.2));
}

TEST_CASE("the work of refinement is the kinetic energy that went missing", "[budget]") {
  const double cut = GENERATE(0.02, 0.1);
  Scene scene = lattice_vortices(48);
  scene.parameters.vorticity_refinement.alpha = 1;
  SECTION("Taylor-Green vortices") {}
  SECTION("a shear wave in 3D") {
    scene = empty_box({0.375, 1, 0.375}, 32);
    scene.gravity = {};
    scene.domain.periodic = {true, true, true};
    scene.fluid = {with_shear_wave(Box{{0, 0, 0}, scene.domain.max}, 1)};
    scene.parameters.pressure.two_sided = true;
    scene.parameters.energy.guard = false;
    scene.parameters.vorticity_refinement.alpha = 1;
  }
  const double whole = kinetic_energy(make_world(scene)), missing = whole * (1 - (1 - cut) * (1 - cut));
  CHECK(after_a_loss(scene, cut).sum("work_vorticity_refinement") == Approx(missing).epsilon(0.05));
  // Nothing is in the guard's reserve yet, so it takes all of that back.
  scene.parameters.energy.guard = true;
  const Account guarded = after_a_loss(scene, cut);
  CHECK(guarded.sum("work_vorticity_refinement") == Approx(missing).epsilon(0.05));
  CHECK(guarded.sum("work_energy_guard") == Approx(-guarded.sum("work_vorticity_refinement")).epsilon(1e-3));
}

TEST_CASE("the works of the micropolar model are those of a wave that grows", "[budget]") {
  // V' = nu_t k W, Theta W' = nu_t (k V - 2 W): flow and spin from V = U, W = 0.
  Scene scene = lattice_vortices(48);
  scene.fluid = {with_shear_wave(Box{{0, 0, 0}, scene.domain.max}, 0.01)};  // slow: the lattice stays
  scene.parameters.micropolar.nu_t = 0.4;
  scene.parameters.micropolar.eta = 0;
  scene.parameters.time.fixed_step = 5e-4;
  Account account(make_world(scene), {FieldId::vorticity});
  const double start = kinetic_energy(account.world), k = wave_number(account.world);
  while (account.world.time < 0.5) account.take_step();
  const MicropolarParameters& p = scene.parameters.micropolar;
  const double t = account.world.time, growth = micropolar_growth(p, k, t), nearby = 1e-4;
  const double slope = (micropolar_growth(p, k, t + nearby) - micropolar_growth(p, k, t - nearby)) / (2 * nearby);
  const double spin = slope / (p.nu_t * k);  // W / U
  CAPTURE(growth, spin);
  CHECK(account.sum("work_micropolar") == Approx(start * (growth * growth - 1)).epsilon(0.02));
  CHECK(account.sum("work_spin") == Approx(start * p.theta * spin * spin).epsilon(0.02));
}

TEST_CASE("confinement's work is epsilon times |omega| |v| over the flow", "[budget]") {
  // Taylor-Green vortices have omega = 2 k U cos X cos Y, which is their stream function times 2 k^2: |omega| rises
  // across the flow, so that the push, epsilon N x omega, is along it.
  Scene scene = lattice_vortices(100);
  scene.parameters.vorticity_confinement.epsilon = 0.1;
  scene.parameters.time.fixed_step = 1e-5;
  Account account(make_world(scene));
  account.take_step();
  double power = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = 2 * pi * (i + 0.5) / n, y = 2 * pi * (j + 0.5) / n;
      const double speed = std::hypot(std::cos(x) * std::sin(y), std::sin(x) * std::cos(y));
      power += 0.1 * 1000 * 4 * pi * std::abs(std::cos(x) * std::cos(y)) * speed / (n * n);
    }
  }
  CHECK(account.sum("work_vorticity_confinement") == Approx(1e-5 * power).epsilon(0.03));
}

TEST_CASE("the work of wavelet turbulence is A e y . v over tau, summed over the water", "[budget]") {
  Scene scene = empty_box({0.5, 0.5, 0.5}, 40);
  scene.gravity = {};
  scene.domain.periodic = {true, true, true};
  scene.fluid = {with_shear_wave(Box{{0, 0, 0}, scene.domain.max}, 1)};
  scene.parameters.wavelet.amplitude = 0.3;
  scene.parameters.wavelet.threshold = 1e-6;
  scene.parameters.wavelet.octaves = 3;
  scene.parameters.wavelet.renewal = 0;  // the noise stays
  scene.parameters.pressure.two_sided = true;
  scene.parameters.time.fixed_step = 1e-5;
  Account account(make_world(scene));
  const World& world = account.world;
  const WaveletParameters& p = world.parameters().wavelet;
  const TurbulenceField noise(*world.wavelet.noise, world.scene.spacing(), p.octaves, 0, 3);
  double power = 0, most = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const double energy = std::max(0.0, double{world.fields.wavelet_energy[i]} - p.threshold);
    const Vec3d push = p.amplitude * energy / p.reference_step * to_double(noise.at(world.fields.position[i]));
    const Vec3d velocity = to_double(world.fields.velocity[i]);
    power += double{world.mass} * dot(push, velocity);
    most += double{world.mass} * length(push) * length(velocity);
  }
  CAPTURE(power, most);
  REQUIRE(std::abs(power) > 0.01 * most);
  account.take_step();
  CHECK(account.sum("work_wavelet_turbulence") == Approx(1e-5 * power).epsilon(0.01));
}

TEST_CASE("what XSPH takes from a shear wave is what the kernel's transform says", "[budget]") {
  // On a lattice v becomes v (1 - gamma (1 - sum V W cos(k y))).
  Scene scene = lattice_vortices(40);
  scene.fluid = {with_shear_wave(Box{{0, 0, 0}, scene.domain.max}, 1)};
  scene.parameters.micropolar.gamma = 0.1;
  scene.parameters.micropolar.xsph_form = MicropolarParameters::xsph_form_t::step;
  scene.parameters.time.fixed_step = 1e-4;
  Account account(make_world(scene));
  const double start = kinetic_energy(account.world), d = scene.spacing(), k = shear_wave_number(scene);
  account.take_step();
  const Kernel& kernel = account.world.kernel;
  double kept = 0;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      kept += kernel.value(d * std::hypot(x, y)) / kernel.lattice_sum(d) * std::cos(k * y * d);
    }
  }
  const double factor = 1 - 0.1 * (1 - kept);
  CHECK(account.sum("loss_xsph") == Approx(start * (1 - factor * factor)).epsilon(1e-3));
}
