// Off costs nothing: what a scene does not need is not planned, not allocated and not run.
#include <algorithm>
#include <catch2/catch.hpp>

#include "sim/core/frame.h"
#include "sim/core/passes.h"

using namespace curlew;

namespace {

Scene small_scene() {
  Scene scene;
  scene.particle_radius = 0.025;
  scene.domain.max = {0.6, 0.6, 0.6};
  scene.fluid.push_back({Box{{0, 0, 0}, {0.4, 0.4, 0.4}}, {}});
  return scene;
}

bool planned(const Plan& plan, std::string_view name) {
  return std::any_of(plan.step.begin(), plan.step.end(), [&](const Pass* pass) { return pass->name == name; });
}

std::vector<std::string_view> names(const Plan& plan) {
  std::vector<std::string_view> all;
  for (const Pass* pass : plan.step) all.push_back(pass->name);
  return all;
}

// Bytes and sweeps of ten steps.
struct Cost {
  std::size_t bytes;
  std::uint64_t sweeps, pair_visits;
  bool operator==(const Cost&) const = default;
};

Cost cost_of(const Scene& scene, FieldSet demanded = {}) {
  World world = make_world(scene);
  const Plan plan = make_plan(world, demanded);
  prepare(world, plan);
  for (int k = 0; k < 10; ++k) step(world, plan);
  return {allocated_bytes(world), world.work.sweeps, world.work.pair_visits};
}

}  // namespace

TEST_CASE("a plain scene plans the plain solver", "[plan]") {
  const World world = make_world(small_scene());
  const Plan plan = make_plan(world);
  CHECK(names(plan) == std::vector<std::string_view>{"energy_watch", "divergence_solve", "gravity", "time_step",
                                                     "apply_forces", "density_solve", "advect", "sort", "neighbours",
                                                     "boundary", "density"});
  CHECK_FALSE(plan.fields.has(FieldId::vorticity));
  CHECK_FALSE(plan.fields.has(FieldId::pressure));
  CHECK_FALSE(plan.fields.has(FieldId::boundary_friction));
}

TEST_CASE("only a body that moves brings the passes and the field of moving bodies", "[plan]") {
  Scene scene = small_scene();
  scene.bodies.push_back({"ball", Sphere{{0.5, 0.3, 0.3}, 0.08}, WallKind::slip});
  const auto at_rest = make_plan(make_world(scene), {FieldId::vorticity});
  scene.bodies[0].motion = KeyframePath({{0, {}}, {1, {}}});
  CHECK(names(make_plan(make_world(scene), {FieldId::vorticity})) == names(at_rest));
  CHECK_FALSE(at_rest.fields.has(FieldId::body_motion));
  const Cost before = cost_of(scene);
  scene.bodies[0].motion = KeyframePath();
  CHECK(cost_of(scene) == before);
  scene.bodies[0].motion = KeyframePath({{0, {}}, {1, {0, 0.1, 0}}});
  const auto moving = make_plan(make_world(scene));
  for (const char* name : {"body_course", "move_bodies", "body_motion"}) {
    CAPTURE(name);
    CHECK(planned(moving, name));
    CHECK_FALSE(planned(at_rest, name));
  }
  CHECK(moving.fields.has(FieldId::body_motion));
}

TEST_CASE("switches bring their passes and fields, and only theirs", "[plan]") {
  Scene scene = small_scene();
  scene.parameters.viscosity.nu = 0.01;
  CHECK(planned(make_plan(make_world(scene)), "viscosity"));
  CHECK_FALSE(make_plan(make_world(scene)).fields.has(FieldId::boundary_friction));
  scene.domain.walls[2].kind = WallKind::no_slip;
  CHECK(make_plan(make_world(scene)).fields.has(FieldId::boundary_friction));
  scene.parameters.viscosity.nu = 0;
  CHECK_FALSE(planned(make_plan(make_world(scene)), "viscosity"));
  CHECK_FALSE(make_plan(make_world(scene)).fields.has(FieldId::boundary_friction));
  scene.parameters.micropolar.gamma = 0.1;
  CHECK(planned(make_plan(make_world(scene)), "xsph"));
  CHECK_FALSE(make_plan(make_world(scene)).fields.has(FieldId::vorticity));
  scene.parameters.vorticity_confinement.epsilon = 0.1;
  CHECK(planned(make_plan(make_world(scene)), "vorticity_confinement"));
  CHECK(planned(make_plan(make_world(scene)), "vorticity"));
  scene.parameters.pressure.max_divergence_iterations = 0;
  CHECK_FALSE(planned(make_plan(make_world(scene)), "divergence_solve"));
  CHECK_FALSE(planned(make_plan(make_world(scene)), "outflow"));
  scene.domain.walls[3].kind = WallKind::open;
  CHECK(planned(make_plan(make_world(scene)), "outflow"));
}

TEST_CASE("without walls and bodies there is no boundary pass", "[plan]") {
  Scene scene = small_scene();
  for (Wall& wall : scene.domain.walls) wall.kind = WallKind::open;
  const Plan plan = make_plan(make_world(scene));
  CHECK_FALSE(planned(plan, "boundary"));
  CHECK_FALSE(plan.fields.has(FieldId::boundary_gradient));
}

TEST_CASE("diagnostics run only where somebody asks for them", "[plan]") {
  const World world = make_world(small_scene());
  CHECK(planned(make_plan(world, {FieldId::vorticity}), "vorticity"));
  CHECK(planned(make_plan(world, {FieldId::pressure}), "pressure"));
  CHECK_FALSE(planned(make_plan(world, {FieldId::density}), "vorticity"));
}

TEST_CASE("what is off costs no byte and no sweep", "[plan]") {
  const Scene plain = small_scene();
  Scene zeroed = plain;
  zeroed.parameters.viscosity.nu = 0;
  zeroed.parameters.micropolar.gamma = 0;
  zeroed.parameters.vorticity_confinement.epsilon = 0;
  zeroed.parameters.vorticity_refinement.alpha = 0;
  zeroed.parameters.micropolar.nu_t = 0;
  zeroed.parameters.wavelet.amplitude = 0;
  zeroed.parameters.sub_particles.levels = 0;
  zeroed.parameters.wavelet.tile = 128;
  // What a model that is off would do must not matter either.
  zeroed.parameters.vorticity_refinement.reconstruction = VorticityRefinementParameters::reconstruction_t::poisson;
  zeroed.parameters.micropolar.curls = MicropolarParameters::curls_t::conjugate;
  zeroed.parameters.micropolar.torque_z = 1;
  CHECK(cost_of(zeroed) == cost_of(plain));
  // The counters are alive: what is on costs something.
  Scene viscous = plain;
  viscous.parameters.viscosity.nu = 1e-6;
  CHECK(cost_of(viscous).sweeps >= cost_of(plain).sweeps + 10);
  CHECK(cost_of(plain, {FieldId::vorticity}).bytes > cost_of(plain).bytes);
}

TEST_CASE("to colour by a model that is off costs no byte and no sweep", "[plan]") {
  Scene scene = small_scene();
  for (const char* colour : {"microrotation", "lost_vorticity"}) {
    INFO(colour);
    CHECK(cost_of(scene, colour_demand(colour)) == cost_of(scene));
  }
}

TEST_CASE("a pass touches only fields that exist", "[plan]") {
  Scene scene = small_scene();
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  for_each_field(world.fields, [&](const FieldRow& row, const auto& array) {
    INFO(row.name);
    const bool expected = row.kind == FieldKind::kept || plan.fields.has(row.id);
    CHECK(array.size() == (expected ? world.count : 0));
  });
}

TEST_CASE("a model that was on and is off again has given its memory back", "[plan]") {
  World world = make_world(small_scene());
  Plan plan = make_plan(world);
  prepare(world, plan);
  for (int k = 0; k < 3; ++k) step(world, plan);
  const std::size_t before = allocated_bytes(world);
  for (const double on : {1.0, 0.0}) {
    world.scene.parameters.vorticity_refinement.alpha = on;
    world.scene.parameters.micropolar.nu_t = 0.1 * on;
    plan = make_plan(world);
    prepare(world, plan);
    for (int k = 0; k < 3; ++k) step(world, plan);
    if (on > 0) CHECK(allocated_bytes(world) > before);
  }
  CHECK(static_cast<double>(allocated_bytes(world)) < 1.01 * static_cast<double>(before));
}
