#include "app/stats.h"

#include "sim/measure/state_hash.h"
#include "sim/sph/pressure.h"

namespace curlew {
namespace {

std::size_t place_of(const std::vector<const Pass*>& passes, const Pass& pass) {
  std::size_t k = 0;
  while (passes[k] != &pass) ++k;
  return k;
}

// A hash of all fields that the pass writes and that exist, particles in storage order.
std::uint64_t written_hash(const Pass& pass, const Fields& fields) {
  std::vector<std::uint64_t> hashes;
  for_each_field(fields, [&](const FieldRow& row, const auto& array) {
    if (pass.writes.has(row.id)) hashes.push_back(array_hash(std::as_bytes(std::span(array))));
  });
  return array_hash(std::as_bytes(std::span(hashes)));
}

std::string text(double value) { return number_text(value); }
std::string text(std::int64_t value) { return std::to_string(value); }

}  // namespace

FieldSet StepRecorder::demand(bool full_columns) { return full_columns ? FieldSet{FieldId::vorticity} : FieldSet{}; }

StepRecorder::StepRecorder(const std::string& folder, const Plan& plan, const Settings& settings)
    : settings_(settings), passes_(plan.step), pass_ms_(passes_.size()), total_ms_(passes_.size()), budget_(plan) {
  stats_ = std::make_unique<CsvWriter>(folder + "/stats.csv", columns(plan), settings.resume_after);
  if (settings.hash_passes > 0) {
    const std::vector<std::string> names{"step", "pass", "hash"};
    hashes_ = std::make_unique<CsvWriter>(folder + "/passes.csv", names, settings.resume_after);
  }
}

std::vector<std::string> StepRecorder::columns(const Plan& plan) const {
  std::vector<std::string> names{"step",
                                 "time",
                                 "dt",
                                 "particles",
                                 "kinetic",
                                 "rotational",
                                 "potential",
                                 "mechanical",
                                 "total",
                                 "max_speed",
                                 "density_error_avg",
                                 "density_error_true_avg",
                                 "density_error_true_max",
                                 "divergence_error",
                                 "pressure_iterations",
                                 "divergence_iterations",
                                 "limit_hits",
                                 "outside",
                                 "ms_step"};
  for (const Pass* pass : plan.step) names.push_back("ms_" + std::string(pass->name));
  if (settings_.full_columns) {
    for (const char* name : {"px", "py", "pz", "lx", "ly", "lz", "enstrophy", "helicity", "divergence_skipped",
                             "divergence_error_after_models", "guard_scale", "wall_contacts"}) {
      names.emplace_back(name);
    }
    for (const EnergyBudget::Term& term : budget_.terms()) names.emplace_back(term.name);
  }
  names.emplace_back("state_hash");
  return names;
}

void StepRecorder::begin_step(const World& world) {
  if (settings_.full_columns) budget_.begin_step(world);
}

void StepRecorder::after(const Pass& pass, const World& world, double milliseconds) {
  const std::size_t k = place_of(passes_, pass);
  pass_ms_[k] = milliseconds;
  total_ms_[k] += milliseconds;
  if (settings_.full_columns) {
    budget_.after(pass, world);
    if (pass.name == "divergence_solve") divergence_after_models_ = world.report.divergence_error;
    if (pass.name == "vorticity_refinement") divergence_after_models_ = divergence_error(world);
  }
  // The step in hand is the one after world.step.
  if (hashes_ && (world.step + 1) % settings_.hash_passes == 0) {
    const std::string cells[] = {text(world.step + 1), std::string(pass.name),
                                 hash_text(written_hash(pass, world.fields))};
    hashes_->row(cells);
  }
}

void StepRecorder::end_step(double milliseconds) { step_ms_ = milliseconds; }

void StepRecorder::write_row(const World& world, bool last) {
  diagnostics_ = diagnose(world);
  outside_ = count_outside(world);
  const Diagnostics& d = diagnostics_;
  const StepReport& r = world.report;
  std::vector<std::string> cells{text(world.step),
                                 text(world.time),
                                 text(world.step > 0 ? world.dt : 0.0),
                                 text(static_cast<std::int64_t>(world.count)),
                                 text(d.kinetic),
                                 text(d.rotational),
                                 text(d.potential),
                                 text(d.mechanical()),
                                 text(d.total()),
                                 text(d.max_speed),
                                 text(r.density_error_avg),
                                 text(r.density_error_true_avg),
                                 text(r.density_error_true_max),
                                 text(r.divergence_error),
                                 std::to_string(r.pressure_iterations),
                                 std::to_string(r.divergence_iterations),
                                 std::to_string(r.limit_hits),
                                 text(outside_),
                                 text(step_ms_)};
  for (double ms : pass_ms_) cells.push_back(text(ms));
  if (settings_.full_columns) {
    for (double value : {d.momentum.x, d.momentum.y, d.momentum.z, d.angular_momentum.x, d.angular_momentum.y,
                         d.angular_momentum.z, enstrophy(world), helicity(world), r.divergence_skipped,
                         divergence_after_models_, r.guard_scale, static_cast<double>(r.wall_contacts)}) {
      cells.push_back(text(value));
    }
    for (const EnergyBudget::Term& term : budget_.terms()) cells.push_back(text(term.step));
  }
  cells.push_back(last || settings_.full_columns ? hash_text(state_hash(world.fields)) : "");
  stats_->row(cells);
  last_row_ = std::move(cells);
}

void StepRecorder::end_early(const World& world) {
  if (last_row_.empty() || last_row_.front() != text(world.step)) return write_row(world, true);
  last_row_.back() = hash_text(state_hash(world.fields));
  stats_->replace_last_row(last_row_);
}

}  // namespace curlew
