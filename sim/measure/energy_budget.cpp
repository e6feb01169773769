#include "sim/measure/energy_budget.h"

#include "sim/core/parallel.h"
#include "sim/measure/diagnostics.h"

namespace curlew {
namespace {

// Passes that do something to the kinetic energy, in the order of the step, and how it is called: what models, gravity
// and bodies do is work, what the others take is a loss. The energy guard changes velocities and forces.
struct Name {
  std::string_view pass, term;
  bool is_work, is_force;
};
constexpr Name names[] = {
    {"divergence_solve", "loss_divergence_solve", false, false},
    {"vorticity_refinement", "work_vorticity_refinement", true, false},
    {"gravity", "work_gravity", true, true},
    {"viscosity", "loss_viscosity", false, true},
    {"vorticity_confinement", "work_vorticity_confinement", true, true},
    {"wavelet_turbulence", "work_wavelet_turbulence", true, true},
    {"micropolar", "work_micropolar", true, true},
    {"energy_guard", "work_energy_guard", true, true},
    {"xsph", "loss_xsph", false, false},
    {"density_solve", "loss_density_solve", false, false},
    {"shift", "loss_shift", false, false},
    {"advect", "loss_advect", false, false},
    {"midpoint", "loss_midpoint", false, false},
    {"reflect", "loss_reflect", false, false},
    {"outflow", "loss_outflow", false, false},
};
constexpr std::string_view rotation = "work_spin", bodies = "work_bodies";

const Name* name_of(const Pass& pass) {
  for (const Name& name : names) {
    if (name.pass == pass.name) return &name;
  }
  return nullptr;
}

}  // namespace

EnergyBudget::EnergyBudget(const Plan& plan) {
  for (const Pass* pass : plan.step) {
    if (const Name* name = name_of(*pass)) terms_.push_back({name->term, pass, name->is_work});
    if (pass->name == "micropolar") {
      spin_ = terms_.size();
      terms_.push_back({rotation, pass, true});
    }
    if (pass->name == "body_course") {
      bodies_ = terms_.size();
      terms_.push_back({bodies, pass, true});
    }
  }
  forces_.resize(terms_.size());
}

void EnergyBudget::begin_step(const World& world) {
  kinetic_ = kinetic_energy(world);
  rotational_ = rotational_energy(world);
  body_work_ = 0;
  for (Term& term : terms_) term.step = 0;
}

EnergyBudget::Term* EnergyBudget::term_of(const Pass& pass) {
  for (Term& term : terms_) {
    if (term.pass == &pass) return &term;
  }
  return nullptr;
}

void EnergyBudget::after(const Pass& pass, const World& world) {
  const Fields& f = world.fields;
  if (pass.name == "apply_forces") {
    share_out(world);
    return;
  }
  const Name* name = name_of(pass);
  if (name == nullptr) return;
  Term& term = *term_of(pass);
  if (name->is_force) {
    Array<Vec3>& force = forces_[static_cast<std::size_t>(&term - terms_.data())];
    force.resize(world.count);
    before_.resize(world.count);
    // Gravity is the first and sets the acceleration.
    const bool first = pass.name == names[2].pass;
    parallel_for(world.count, [&](std::size_t i) {
      force[i] = first ? f.acceleration[i] : f.acceleration[i] - before_[i];
      before_[i] = f.acceleration[i];
    });
  }
  if (!name->is_force || pass.changes_velocity) {
    const double now = kinetic_energy(world);
    term.step = term.is_work ? now - kinetic_ : kinetic_ - now;
    kinetic_ = now;
  }
  if (bodies_ < terms_.size() && !term.is_work) {
    const double done = world.report.body_work - body_work_;
    term.step += done;
    terms_[bodies_].step += done;
    body_work_ += done;
  }
  if (pass.writes.has(FieldId::microrotation) && spin_ < terms_.size()) {
    const double now = rotational_energy(world);
    terms_[spin_].step += now - rotational_;
    rotational_ = now;
  }
}

// dt sum m a_k . v in the middle between before and after the forces.
void EnergyBudget::share_out(const World& world) {
  const Fields& f = world.fields;
  const double dt = world.dt;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    Term& term = terms_[k];
    if (forces_[k].size() != world.count || forces_[k].empty()) continue;
    const double given = dt * double{world.mass} * particle_sum(world.count, [&](std::size_t i) {
                           const Vec3d middle = to_double(f.velocity[i]) - 0.5 * dt * to_double(f.acceleration[i]);
                           return dot(to_double(forces_[k][i]), middle);
                         });
    term.step += term.is_work ? given : -given;
  }
  kinetic_ = kinetic_energy(world);
}

}  // namespace curlew
