#include "sim/core/passes.h"

#include <chrono>

#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/core/watch.h"
#include "sim/sph/density.h"
#include "sim/sph/motion.h"
#include "sim/sph/moving_bodies.h"
#include "sim/sph/pressure.h"
#include "sim/sph/projection.h"
#include "sim/turbulence/energy_guard.h"
#include "sim/turbulence/micropolar_bender2018.h"
#include "sim/turbulence/sub_particles_fujisawa2011.h"
#include "sim/turbulence/vorticity_confinement_macklin2013.h"
#include "sim/turbulence/vorticity_refinement_liu2020.h"
#include "sim/turbulence/wavelet_turbulence_fujisawa2011.h"

namespace curlew {
namespace {

using enum FieldId;

bool always(const World&) { return true; }
bool has_boundary(const World& w) { return w.has_boundary(); }
bool has_moving_body(const World& w) { return w.bodies.any_moving(); }
bool solves_divergence(const World& w) { return w.parameters().pressure.max_divergence_iterations > 0; }
bool is_filled(const World& w) { return w.parameters().pressure.two_sided; }
bool shifts_particles(const World& w) { return is_filled(w) && w.parameters().pressure.shifting > 0; }
bool conserves_energy(const World& w) {
  return is_filled(w) && solves_divergence(w) && w.parameters().pressure.conserving;
}
bool has_open_face(const World& w) {
  const Domain& domain = w.scene.domain;
  for (int axis = 0; axis < w.scene.dimension; ++axis) {
    const bool open =
        domain.walls[2 * axis].kind == WallKind::open || domain.walls[2 * axis + 1].kind == WallKind::open;
    if (open && !domain.periodic[axis]) return true;
  }
  return false;
}
bool is_viscous(const World& w) { return w.parameters().viscosity.nu > 0; }
bool confines_vorticity(const World& w) { return w.parameters().vorticity_confinement.epsilon > 0; }
bool adds_wavelets(const World& w) { return w.parameters().wavelet.amplitude > 0; }
bool splits_particles(const World& w) { return w.scene.dimension == 3 && w.parameters().sub_particles.levels > 0; }
bool is_micropolar(const World& w) { return transfer_coefficient(w.parameters()) != 0; }
bool refines_vorticity(const World& w) { return w.parameters().vorticity_refinement.alpha > 0; }
bool solves_poisson(const World& w) {
  using enum VorticityRefinementParameters::reconstruction_t;
  return refines_vorticity(w) && w.parameters().vorticity_refinement.reconstruction == poisson;
}
bool guards_energy(const World& w) {
  return w.parameters().energy.guard &&
         (confines_vorticity(w) || is_micropolar(w) || refines_vorticity(w) || adds_wavelets(w));
}
bool uses_xsph(const World& w) { return w.parameters().micropolar.gamma > 0; }

constexpr FieldSet particle_state = FieldSet::kept();
constexpr FieldSet boundary_fields{boundary_gradient, boundary_friction, no_slip_gradient};
constexpr FieldSet solver_space{packed, acceleration, source, iterate};
constexpr FieldSet filled_fields{displacement, correction_diagonal, correction_mixed, corrected_diagonal};
constexpr FieldSet solver_input =
    FieldSet{position, velocity, density, diagonal, neighbour_number, boundary_gradient, body_motion} | solver_space |
    filled_fields;

constexpr Pass passes[] = {
    {.name = "energy_watch",
     .reads = particle_state,
     .writes = {},
     .wanted = always,
     .run = watch_energy,
     .essential = true},
    // At the positions that the last step left, with the step that it took:
    {.name = "divergence_solve",
     .reads = solver_input | FieldSet{divergence_stiffness},
     .writes = FieldSet{velocity, divergence_stiffness, pressure_acceleration} | solver_space,
     .wanted = solves_divergence,
     .run = divergence_solve,
     .changes_velocity = true},
    {.name = "vorticity_refinement",
     .reads = {position, velocity, density, neighbour_number, predicted_vorticity, boundary_friction},
     .writes = {velocity, lost_vorticity, stream_function, model_velocity},
     .wanted = refines_vorticity,
     .run = refine_vorticity,
     .changes_velocity = true},
    // Forces and the new step:
    {.name = "gravity", .reads = {}, .writes = {acceleration, model_acceleration}, .wanted = always, .run = gravity},
    {.name = "viscosity",
     .reads = {position, velocity, density, acceleration, boundary_friction, correction_diagonal},
     .writes = {acceleration},
     .wanted = is_viscous,
     .run = viscosity},
    {.name = "vorticity_confinement",
     .reads = {position, vorticity, acceleration, model_acceleration},
     .writes = {acceleration, model_acceleration},
     .wanted = confines_vorticity,
     .run = vorticity_confinement},
    {.name = "time_step",
     .reads = {velocity, acceleration},
     .writes = {},
     .wanted = always,
     .run = choose_time_step,
     .essential = true},
    // Models whose push grows without a limit: the guard bounds it, the time step does not follow it.
    {.name = "wavelet_turbulence",
     .reads = {position, wavelet_energy, acceleration, model_acceleration},
     .writes = {acceleration, model_acceleration},
     .wanted = adds_wavelets,
     .run = add_wavelet_turbulence},
    {.name = "micropolar",
     .reads = {position, velocity, density, acceleration, model_acceleration, microrotation, no_slip_gradient,
               body_motion},
     .writes = {acceleration, model_acceleration, microrotation, packed},
     .wanted = is_micropolar,
     .run = couple_spin_and_flow},
    {.name = "energy_guard",
     .reads = {velocity, acceleration, model_velocity, model_acceleration, microrotation, packed},
     .writes = {velocity, acceleration, model_velocity, model_acceleration, microrotation},
     .wanted = guards_energy,
     .run = guard_energy,
     .changes_velocity = true},
    {.name = "apply_forces",
     .reads = {velocity, acceleration},
     .writes = {velocity},
     .wanted = always,
     .run = apply_forces,
     .changes_velocity = true},
    {.name = "xsph",
     .reads = {position, velocity, density},
     .writes = {velocity, acceleration},
     .wanted = uses_xsph,
     .run = xsph,
     .changes_velocity = true},
    {.name = "vorticity_prediction",
     .reads = {position, velocity, density},
     .writes = {predicted_vorticity},
     .wanted = refines_vorticity,
     .run = predict_vorticity},
    {.name = "midpoint",
     .reads = {velocity, pressure_acceleration},
     .writes = {velocity},
     .wanted = conserves_energy,
     .run = midpoint_velocity,
     .changes_velocity = true},
    {.name = "body_course",
     .reads = {position, body_motion},
     .writes = {body_motion},
     .wanted = has_moving_body,
     .run = sum_body_course},
    // Constant density at the positions to come:
    {.name = "density_solve",
     .reads = solver_input | FieldSet{density_stiffness},
     .writes = FieldSet{velocity, density_stiffness, displacement} | solver_space,
     .wanted = always,
     .run = density_solve,
     .changes_velocity = true},
    {.name = "shift",
     .reads = {position, velocity, density, boundary_gradient, displacement, microrotation},
     .writes = {position, velocity, acceleration, packed, microrotation},
     .wanted = shifts_particles,
     .run = shift_particles},
    {.name = "move_bodies",
     .reads = {},
     .writes = {},
     .wanted = has_moving_body,
     .run = move_bodies,
     .essential = true},
    {.name = "advect",
     .reads = {position, velocity, displacement},
     .writes = {position, velocity},
     .wanted = always,
     .run = advect},
    {.name = "reflect",
     .reads = {velocity, pressure_acceleration},
     .writes = {velocity},
     .wanted = conserves_energy,
     .run = reflect_velocity,
     .changes_velocity = true},
    {.name = "energy_account",
     .reads = {velocity, microrotation},
     .writes = {},
     .wanted = guards_energy,
     .run = account_energy,
     .essential = true},
    {.name = "outflow",
     .reads = particle_state,
     .writes = particle_state,
     .wanted = has_open_face,
     .run = remove_escaped},
    // The new positions:
    {.name = "sort", .reads = particle_state, .writes = particle_state, .wanted = always, .run = sort_particles},
    {.name = "neighbours",
     .reads = {position},
     .writes = {},
     .wanted = always,
     .run = find_neighbours,
     .essential = true},
    {.name = "boundary",
     .reads = {position},
     .writes = boundary_fields | FieldSet{neighbour_number},
     .wanted = has_boundary,
     .run = boundary_sums},
    {.name = "body_motion",
     .reads = {position, boundary_friction},
     .writes = {body_motion, boundary_friction},
     .wanted = has_moving_body,
     .run = sum_body_motion},
    {.name = "density",
     .reads = {position, boundary_gradient, neighbour_number},
     .writes = {density, diagonal, neighbour_number},
     .wanted = always,
     .run = compute_density},
    {.name = "gradient_correction",
     .reads = {position, density, boundary_gradient},
     .writes = {correction_diagonal, correction_mixed, corrected_diagonal},
     .wanted = is_filled,
     .run = gradient_correction},
    {.name = "wavelet_drift",
     .reads = {},
     .writes = {},
     .wanted = adds_wavelets,
     .run = drift_wavelet_noise,
     .essential = true},
    // Only for those who ask:
    {.name = "pressure",
     .reads = {position, density, boundary_gradient, density_stiffness, divergence_stiffness},
     .writes = {pressure},
     .wanted = always,
     .run = total_pressure},
    {.name = "vorticity",
     .reads = {position, velocity, density, no_slip_gradient, body_motion},
     .writes = {vorticity},
     .wanted = always,
     .run = compute_vorticity},
    {.name = "wavelet_energy",
     .reads = {position, velocity},
     .writes = {wavelet_energy},
     .wanted = always,
     .run = find_wavelet_energy},
    {.name = "sub_particles",
     .reads = {wavelet_energy, density, sub_particles},
     .writes = {sub_particles},
     .wanted = splits_particles,
     .run = advance_sub_particles,
     .essential = true},
};

// Whether a pass advances the state, rather than find out what depends on positions alone.
bool advances(const Pass& pass) {
  return pass.changes_velocity || pass.writes.meets(FieldSet{acceleration} | FieldSet::of(FieldKind::model)) ||
         pass.name == "time_step" || pass.name == "wavelet_drift" || pass.name == "advect" ||
         pass.name == "body_course" || pass.name == "move_bodies" || pass.name == "energy_account" ||
         pass.name == "energy_watch";
}

// Fields that a pass touches but that this world has no use for.
FieldSet unused_fields(const World& world, FieldSet demanded) {
  FieldSet unused;
  if (!is_filled(world)) unused = unused | filled_fields;
  if (!conserves_energy(world)) unused = unused | FieldSet{pressure_acceleration, corrected_diagonal};
  if (!world.has_boundary()) unused = unused | boundary_fields;
  if (!has_moving_body(world)) unused = unused | FieldSet{body_motion};
  if (solves_poisson(world)) unused = unused | FieldSet{stream_function};
  if (!guards_energy(world) || !refines_vorticity(world)) unused = unused | FieldSet{model_velocity};
  if (!guards_energy(world) || !(confines_vorticity(world) || is_micropolar(world) || adds_wavelets(world))) {
    unused = unused | FieldSet{model_acceleration};
  }
  if (!splits_particles(world)) unused = unused | FieldSet{sub_particles};
  if (!is_micropolar(world)) unused = unused | FieldSet{microrotation};
  const bool no_slip = world.walls.any_no_slip() || world.bodies.any_no_slip();
  if (!is_viscous(world) || !no_slip) unused = unused | FieldSet{boundary_friction};
  const bool curls = confines_vorticity(world) || is_micropolar(world);
  if (!world.bodies.any_no_slip() || !(curls || demanded.has(vorticity))) {
    unused = unused | FieldSet{no_slip_gradient};
  }
  return unused;
}

void save_backup(World& world) {
  Backup& b = world.backup;
  b.velocity.resize(world.count);
  b.density_stiffness.resize(world.count);
  b.divergence_stiffness.resize(world.count);
  parallel_for(world.count, [&](std::size_t i) {
    b.velocity[i] = world.fields.velocity[i];
    b.density_stiffness[i] = world.fields.density_stiffness[i];
    b.divergence_stiffness[i] = world.fields.divergence_stiffness[i];
  });
  b.microrotation = world.fields.microrotation;
  b.predicted_vorticity = world.fields.predicted_vorticity;
}

// Positions move last, so the velocities, the models' fields and the warm start are all that a step that failed has
// changed.
void restore_backup(World& world) {
  world.fields.velocity = world.backup.velocity;
  world.fields.density_stiffness = world.backup.density_stiffness;
  world.fields.divergence_stiffness = world.backup.divergence_stiffness;
  world.fields.microrotation = world.backup.microrotation;
  world.fields.predicted_vorticity = world.backup.predicted_vorticity;
}

void run_passes(World& world, const std::vector<const Pass*>& list, PassObserver* observer) {
  using Clock = std::chrono::steady_clock;
  for (const Pass* pass : list) {
    const auto begin = Clock::now();
    pass->run(world);
    if (pass->changes_velocity) check_velocities(world, pass->name);
    const std::chrono::duration<double, std::milli> taken = Clock::now() - begin;
    if (observer != nullptr) observer->after(*pass, world, taken.count());
  }
}

}  // namespace

std::span<const Pass> pass_table() { return passes; }

Plan make_plan(const World& world, FieldSet demanded) {
  const FieldSet unused = unused_fields(world, demanded);
  FieldSet needed = FieldSet::kept() | demanded;
  std::vector<bool> chosen(std::size(passes));
  // A step ends with passes that the next one's beginning reads, so go round until nothing is added.
  for (bool grown = true; grown;) {
    grown = false;
    for (std::size_t p = std::size(passes); p-- > 0;) {
      const Pass& pass = passes[p];
      if (chosen[p] || !pass.wanted(world) || !(pass.essential || pass.writes.meets(needed))) continue;
      chosen[p] = grown = true;
      needed = needed | pass.reads.without(unused);
    }
  }
  Plan plan;
  for (std::size_t p = 0; p < std::size(passes); ++p) {
    if (!chosen[p]) continue;
    const Pass& pass = passes[p];
    plan.step.push_back(&pass);
    plan.fields = plan.fields | pass.reads.without(unused) | pass.writes.without(unused);
    if (!advances(pass)) plan.prepare.push_back(&pass);
  }
  return plan;
}

void allocate(World& world, const Plan& plan) {
  for_each_field(world.fields, [&](const FieldRow& row, auto& array) {
    const bool present = row.kind == FieldKind::kept || plan.fields.has(row.id);
    if (present) {
      array.resize(world.count);
    } else {
      array = std::remove_cvref_t<decltype(array)>();  // gives the memory back; "= {}" would keep it
    }
  });
  for_each_field(world.sort_space, [&](const FieldRow& row, auto& array) {
    if (row.kind != FieldKind::kept && !plan.fields.has(row.id)) array = std::remove_cvref_t<decltype(array)>();
  });
  if (world.fields.microrotation.empty()) world.backup.microrotation = Array<Vec3>();
  if (world.fields.predicted_vorticity.empty()) world.backup.predicted_vorticity = Array<Vec3>();
  if (!guards_energy(world)) world.energy = {};
  if (!adds_wavelets(world)) {
    world.wavelet = {};
  } else if (world.wavelet.noise == nullptr) {
    world.wavelet.noise = make_wavelet_noise(world.parameters().wavelet, world.seed);
  }
  if (!solves_poisson(world)) {
    world.potential = {};
  } else if (world.potential.empty()) {
    world.potential = VectorPotential(world.scene);
  }
}

void prepare(World& world, const Plan& plan) {
  allocate(world, plan);
  place_bodies(world, world.time);
  run_passes(world, plan.prepare, nullptr);
  remember_start(world);
  if (world.dt <= 0) world.dt = initial_time_step(world);
}

void step(World& world, const Plan& plan, PassObserver* observer) {
  const double last_dt = world.dt;
  world.report.limit_hits = 0;
  world.report.body_work = 0;
  save_backup(world);
  try {
    run_passes(world, plan.step, observer);
  } catch (const DivergedError&) {
    restore_backup(world);
    world.dt = last_dt;
    place_bodies(world, world.time);
    throw;
  }
  world.time += world.dt;
  ++world.step;
}

}  // namespace curlew
