// The energy guard: models give back at most what the solver has lost.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "sim/core/error.h"
#include "sim/measure/diagnostics.h"
#include "sim/measure/state_hash.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

// Every model, driven far harder than its paper advises.
struct Excess {
  const char* name;
  void (*set)(Parameters&);
};
constexpr Excess excesses[] = {
    {"refinement", [](Parameters& p) { p.vorticity_refinement.alpha = 2; }},
    {"refinement by the sum",
     [](Parameters& p) {
       p.vorticity_refinement.alpha = 3;
       p.vorticity_refinement.reconstruction = VorticityRefinementParameters::reconstruction_t::sum;
     }},
    {"micropolar", [](Parameters& p) { p.micropolar.nu_t = 1; }},
    {"confinement", [](Parameters& p) { p.vorticity_confinement.epsilon = 2; }},
    {"all",
     [](Parameters& p) {
       p.vorticity_refinement.alpha = 2;
       p.micropolar.nu_t = 1;
       p.vorticity_confinement.epsilon = 2;
       p.wavelet.amplitude = 0.5;
     }},
};

struct Energies {
  double start = 0, most = 0, kinetic = 0;  // J: total at the start, its maximum, kinetic energy at the end
};

Energies energies_of(Scene scene, double time) {
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  Energies e;
  e.start = e.most = diagnose(world).total();
  while (world.time < time) {
    step(world, plan);
    e.most = std::max(e.most, diagnose(world).total());
  }
  e.kinetic = kinetic_energy(world);
  return e;
}

Scene small_dam() { return at_particles_per_metre(bundled("dam_break_2d"), 30); }

}  // namespace

TEST_CASE("whatever the models do, guarded water never has more energy than it had", "[guard]") {
  for (const Excess& excess : excesses) {
    INFO(excess.name);
    Scene scene = small_dam();
    excess.set(scene.parameters);
    const Energies guarded = energies_of(scene, 2);
    CHECK(guarded.most < 1.005 * guarded.start);
  }
}

TEST_CASE("without the guard the same models bring energy from nowhere", "[guard]") {
  Scene scene = small_dam();
  scene.parameters.energy.guard = false;
  scene.parameters.vorticity_confinement.epsilon = 2;
  try {
    const Energies free = energies_of(scene, 2);
    CHECK(free.most > 1.05 * free.start);
  } catch (const DivergedError& error) {
    SUCCEED(error.what());
  }
}

TEST_CASE("under the guard a dam break calms down as it does without models", "[guard]") {
  const auto kinetic_of_last_second = [](const Scene& scene) {
    Run run(scene);
    run.simulate(8);
    double sum = 0, time = 0;
    for (const Moment& m : run.history()) {
      if (m.time > 7) sum += m.dt * m.sums.kinetic, time += m.dt;
    }
    return sum / time;
  };
  const double plain = kinetic_of_last_second(small_dam());
  for (const Excess& excess : excesses) {
    INFO(excess.name);
    Scene scene = small_dam();
    excess.set(scene.parameters);
    CHECK(kinetic_of_last_second(scene) < 2 * plain);
  }
}

TEST_CASE("the guard keeps the momentum that a model keeps", "[guard]") {
  Scene scene = bundled("spinning_drop");
  scene.particle_radius *= 2;
  scene.parameters.micropolar.nu_t = 2;
  scene.parameters.micropolar.curls = MicropolarParameters::curls_t::conjugate;
  Run run(scene);
  run.simulate(0.5);
  CHECK(run.world.report.guard_scale < 1);
  const Diagnostics &now = run.now().sums, &start = run.history().front().sums;
  CHECK(length(now.momentum - start.momentum) < 1e-6 * length(start.angular_momentum) / 0.3);
}

TEST_CASE("in still water there is nothing to give back", "[guard]") {
  Scene scene = at_particles_per_metre(bundled("still_tank"), 14);
  scene.parameters.vorticity_confinement.epsilon = 1;
  scene.parameters.micropolar.nu_t = 0.5;
  Scene without = at_particles_per_metre(bundled("still_tank"), 14);
  Run run(scene), plain(without);
  run.simulate(2);
  plain.simulate(2);
  CHECK(run.now().sums.kinetic < 2 * plain.now().sums.kinetic);
}

TEST_CASE("where the guard has nothing to take back, its bits are those without it", "[guard]") {
  // At first a vortex loses more than a weak model gives.
  Scene scene = at_particles_per_metre(bundled("gresho_chan"), 30);
  scene.parameters.vorticity_refinement.alpha = 0.2;
  Run guarded(scene);
  scene.parameters.energy.guard = false;
  Run free(scene);
  int steps = 0;
  for (; steps < 20; ++steps) {
    guarded.take_steps(1);
    if (guarded.world.report.guard_scale < 1) break;
    free.take_steps(1);
    CHECK(state_hash(guarded.world.fields) == state_hash(free.world.fields));
  }
  CHECK(steps > 0);
}

TEST_CASE("without models, and without the guard, there are no guarding passes and no fields for them", "[guard]") {
  Scene scene = small_dam();
  const auto guards = [&] {
    const World world = make_world(scene);
    const Plan plan = make_plan(world);
    const bool passes = std::any_of(plan.step.begin(), plan.step.end(), [](const Pass* pass) {
      return pass->name == "energy_guard" || pass->name == "energy_account";
    });
    CHECK(plan.fields.meets({FieldId::model_velocity, FieldId::model_acceleration}) == passes);
    return passes;
  };
  CHECK_FALSE(guards());
  scene.parameters.micropolar.nu_t = 0.1;
  CHECK(guards());
  scene.parameters.energy.guard = false;
  CHECK_FALSE(guards());
}

TEST_CASE("what an external torque brings is not taken for growth", "[guard]") {
  Scene scene = bundled("spinning_drop");
  scene.particle_radius *= 2;
  scene.parameters.micropolar.nu_t = 0.01;
  scene.parameters.micropolar.torque_z = 5;
  const auto spin_after = [&](bool guard) {
    scene.parameters.energy.guard = guard;
    Run run(scene);
    run.simulate(0.2);
    return run.now().sums.rotational;
  };
  CHECK(spin_after(true) == Approx(spin_after(false)).epsilon(0.05));
}
