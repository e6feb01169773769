#include "sim/turbulence/energy_guard.h"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"

namespace curlew {
namespace {

constexpr double farthest = 0.1;  // that the models may move a particle in a step, in spacings

// The energy per mass that a share s of all changes adds is s linear + s^2 square; what an external torque does about
// it is `driven`.
struct Added {
  double linear = 0, square = 0, driven = 0;
  void operator+=(const Added& other) {
    linear += other.linear;
    square += other.square;
    driven += other.driven;
  }
};

// Vectors that a plan without their pass does not have are zero.
Vec3 value(const Array<Vec3>& field, std::size_t i) { return field.empty() ? Vec3{} : field[i]; }

// The models' change of a particle's velocity must not exceed `most`.
void limit_change(Fields& f, std::size_t i, float dt, float most) {
  const Vec3 given = value(f.model_velocity, i), pushed = value(f.model_acceleration, i);
  const float size = length(given + dt * pushed);
  if (size <= most) return;
  const float kept = most / size;
  if (!f.model_velocity.empty()) {
    f.velocity[i] += (kept - 1) * given;
    f.model_velocity[i] = kept * given;
  }
  if (!f.model_acceleration.empty()) {
    f.acceleration[i] += (kept - 1) * pushed;
    f.model_acceleration[i] = kept * pushed;
  }
}

// The largest s from 0 to 1 with s linear + s^2 square <= most; most >= 0.
double largest_share(const Added& added, double most) {
  if (added.linear + added.square <= most) return 1;
  const double root = std::sqrt(added.linear * added.linear + 4 * added.square * most);
  // Of the two forms of the root the one that does not cancel.
  const double share = added.linear > 0 ? 2 * most / (added.linear + root) : (root - added.linear) / (2 * added.square);
  return std::clamp(share, 0.0, 1.0);
}

void scale_change(World& world, double share) {
  Fields& f = world.fields;
  const bool spins = !f.microrotation.empty();
  const auto taken = static_cast<float>(1 - share);
  parallel_for(world.count, [&](std::size_t i) {
    if (!f.model_velocity.empty()) f.velocity[i] += -taken * f.model_velocity[i];
    if (!f.model_acceleration.empty()) {
      const Vec3 back = -taken * f.model_acceleration[i];
      f.acceleration[i] += back;
      f.model_acceleration[i] += back;
    }
    if (spins) f.microrotation[i] += taken * (f.packed[i] - f.microrotation[i]);
  });
}

// dt sum m a . v in the middle of the step, a the acceleration by viscosity: what is left of the sum of all.
double viscous_work(const World& world) {
  if (world.parameters().viscosity.nu == 0) return 0;
  const Fields& f = world.fields;
  const Vec3d g = world.scene.gravity;
  const double dt = world.dt;
  return dt * double{world.mass} * particle_sum(world.count, [&](std::size_t i) {
           const Vec3d all = to_double(f.acceleration[i]);
           const Vec3d viscous = all - g - to_double(value(f.model_acceleration, i));
           return dot(viscous, to_double(f.velocity[i]) + 0.5 * dt * all);
         });
}

}  // namespace

void guard_energy(World& world) {
  Fields& f = world.fields;
  const MicropolarParameters& micropolar = world.parameters().micropolar;
  const Vec3d torque{micropolar.torque_x, micropolar.torque_y, micropolar.torque_z};
  const double dt = world.dt, theta = micropolar.theta;
  const auto most = static_cast<float>(farthest * world.scene.spacing() / dt), step = static_cast<float>(dt);
  const bool spins = !f.microrotation.empty();
  const auto sums = ordered_sum<Added>(world.count, [&](std::size_t begin, std::size_t end) {
    Added added;
    for (std::size_t i = begin; i < end; ++i) {
      limit_change(f, i, step, most);
      const Vec3d given = to_double(value(f.model_velocity, i)), before = to_double(f.velocity[i]) - given;
      const Vec3d change = given + dt * to_double(value(f.model_acceleration, i));
      added += {dot(before, change), 0.5 * dot(change, change), 0};
      if (!spins) continue;
      const Vec3d spin = to_double(f.packed[i]), turned = to_double(f.microrotation[i]) - spin;
      added += {theta * dot(spin, turned), 0.5 * theta * dot(turned, turned), dt * dot(torque, spin + 0.5 * turned)};
    }
    return added;
  });
  const double driven = double{world.mass} * sums.driven;
  const double share = largest_share(sums, std::max(0.0, world.energy.reserve + driven) / double{world.mass});
  world.report.guard_scale = share;
  if (share < 1) scale_change(world, share);
  world.energy.outer_work = driven + viscous_work(world);
  world.energy.given = double{world.mass} * share * (sums.linear + share * sums.square) - driven;
}

void account_energy(World& world) {
  const Fields& f = world.fields;
  const Backup& before = world.backup;
  const double theta = world.parameters().micropolar.theta;
  const Vec3d fall = world.dt * world.scene.gravity;
  const bool spins = !f.microrotation.empty();
  const double missing = particle_sum(world.count, [&](std::size_t i) {
    const Vec3d v = to_double(f.velocity[i]), u = to_double(before.velocity[i]);
    double lost = 0.5 * (dot(u, u) - dot(v, v)) + dot(fall, v);
    if (spins) {
      const Vec3d spin = to_double(f.microrotation[i]), last = to_double(before.microrotation[i]);
      lost += 0.5 * theta * (dot(last, last) - dot(spin, spin));
    }
    return lost;
  });
  const EnergyParameters& p = world.parameters().energy;
  EnergyAccount& account = world.energy;
  const double loss = double{world.mass} * missing + account.outer_work + account.given + world.report.body_work;
  const double kept = account.reserve > 0 ? account.reserve * std::exp(-world.dt / p.memory) : account.reserve;
  account.reserve = kept + p.share * loss - account.given;
}

}  // namespace curlew
