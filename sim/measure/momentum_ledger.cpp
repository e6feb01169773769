#include "sim/measure/momentum_ledger.h"

#include <cmath>

#include "sim/core/parallel.h"
#include "sim/measure/diagnostics.h"
#include "sim/turbulence/micropolar_bender2018.h"

namespace curlew {

Momenta momenta(const World& world) {
  const Diagnostics sums = diagnose(world);
  Momenta now{sums.momentum, sums.angular_momentum, {}};
  const Array<Vec3>& omega = world.fields.microrotation;
  if (omega.empty()) return now;
  for (int axis = 0; axis < 3; ++axis) {
    now.spin[axis] = world.parameters().micropolar.theta * double{world.mass} *
                     particle_sum(world.count, [&](std::size_t i) { return double{omega[i][axis]}; });
  }
  return now;
}

double absolute_momentum_sum(const World& world) {
  return double{world.mass} *
         particle_sum(world.count, [&](std::size_t i) { return length(to_double(world.fields.velocity[i])); });
}

void MomentumLedger::after(const Pass& pass, const World& world, double) {
  const Momenta now = momenta(world);
  Momenta& change = changes[std::string(pass.name)];
  change.linear += now.linear - last.linear;
  change.orbital += now.orbital - last.orbital;
  change.spin += now.spin - last.spin;
  if (pass.name == "micropolar") {
    // The pass takes omega towards curl v / 2 by the factor `kept`: the sums before and after give that of curl v.
    const double rate = 2 * transfer_coefficient(world.parameters()) / world.parameters().micropolar.theta;
    const double kept = std::exp(-rate * world.dt);
    curl_torque += rate * world.dt / (1 - kept) * (now.spin - kept * last.spin);
    spin_torque += rate * world.dt * last.spin;
  }
  last = now;
}

Momenta MomentumLedger::by(const std::string& pass) const {
  const auto found = changes.find(pass);
  return found == changes.end() ? Momenta{} : found->second;
}

}  // namespace curlew
