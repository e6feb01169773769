// A drop that turns like a rigid body and that nothing outside acts on: what each method does to its linear and angular
// momentum, and why (see momentum_ledger.h).
#include <cmath>
#include <cstdio>

#include "app/accuracy.h"
#include "app/progress.h"
#include "sim/core/error.h"
#include "sim/measure/momentum_ledger.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

constexpr double duration = 1.0;  // s; at 1 rad/s the drop has then grown by sqrt(2) across its axis

std::vector<AccuracyMethod> methods() {
  std::vector<AccuracyMethod> all = accuracy_methods();
  const auto at = all.begin() + 4;  // after MP
  all.insert(at, {{"MP 0.05 symmetric", {"micropolar.nu_t=0.05", "micropolar.eta=0", "micropolar.curls=symmetric"}},
                  {"MP 0.05 conjugate", {"micropolar.nu_t=0.05", "micropolar.eta=0", "micropolar.curls=conjugate"}},
                  {"MP 0.05 eta 0.125", {"micropolar.nu_t=0.05"}},
                  {"MP full nu 0.01", {"micropolar.nu_t=0.05", "micropolar.model=full", "viscosity.nu=0.01"}}});
  return all;
}

struct DropRow {
  std::vector<std::string> cells;
  std::string notes;  // what the residual is made of, and the passes that changed linear or orbital momentum
};

DropRow measure(const Scene& scene, const AccuracyMethod& method, double time) {
  World world = make_world(with_method(scene, method));
  const Plan plan = make_plan(world);
  prepare(world, plan);
  MomentumLedger ledger(world);
  const Momenta start = ledger.last;
  const double linear = absolute_momentum_sum(world), angular = length(start.orbital);
  const std::size_t particles = world.count;
  Progress progress(false);
  while (world.time < time) {
    step(world, plan, &ledger);
    progress.show(world.time / time, method.name);
  }
  const Momenta now = momenta(world);
  const Vec3d drift = now.orbital + now.spin - start.orbital - start.spin;
  const auto share = [&](Vec3d v) { return formatted("%+.1e", v.z / angular); };
  DropRow row;
  row.cells = {method.name,
               formatted("%.1e", length(now.linear - start.linear) / linear),
               share(now.orbital - start.orbital),
               share(now.spin - start.spin),
               share(drift),
               share(ledger.curl_torque),
               share(drift - ledger.curl_torque),
               std::to_string(particles - world.count)};
  if (!world.fields.microrotation.empty()) {
    const Vec3d surface = ledger.by("apply_forces").orbital - ledger.spin_torque;
    row.notes = " surface term " + share(surface) + ", rest " + share(drift - ledger.curl_torque - surface) + ";";
  }
  for (const auto& [pass, change] : ledger.changes) {
    const double p = length(change.linear) / linear, l = length(change.orbital) / angular;
    if (p > 1e-6 || l > 1e-6) row.notes += " " + pass + formatted(" %.1e", p) + formatted(" %.1e;", l);
  }
  return row;
}

}  // namespace

void spinning_drop_accuracy(const BenchOptions& options) {
  for (const Scene& scene : accuracy_scenes("spinning_drop", options)) {
    const double time = duration * options.time_share;
    // L begins at 2/5 M R^2 w; particles that fly straight on have curl v = 2 w / (1 + (w t)^2).
    const double rate = scene.fluid.at(0).velocity.rate.z, radius = std::get<Sphere>(scene.fluid.at(0).shape).radius;
    const double torque = 5 * 0.05 * std::atan(rate * time) / (radius * radius * rate);
    std::printf("\nspinning_drop: %.3f s; linear momentum as a share of sum m |v|, angular (z) of L at the start\n\n",
                time);
    AccuracyTable table{{"method", "linear drift", "change of L", "change of S", "change of L + S",
                         "torque c int rho curl v", "residual", "particles lost"},
                        {}};
    std::string notes;
    for (const AccuracyMethod& method : methods()) {
      DropRow row;
      try {
        row = measure(scene, method, time);
      } catch (const DivergedError& error) {
        row.cells = {method.name, "diverged"};
        row.cells.resize(table.columns.size());
        row.notes = " " + std::string(error.what());
      }
      table.rows.push_back(row.cells);
      notes += method.name + ":" + row.notes + "\n";
    }
    table.print();
    std::printf("\nTorque on paper for c = 0.05 m^2/s: %.2f.\n", torque);
    std::printf("\nOf the residual, and by passes (linear, angular):\n\n%s", notes.c_str());
    table.write("accuracy_spinning_drop_" + std::to_string(std::llround(estimate_particles(scene))), options);
  }
}

}  // namespace curlew
