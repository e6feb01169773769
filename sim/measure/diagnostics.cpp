#include "sim/measure/diagnostics.h"

#include "sim/core/parallel.h"

namespace curlew {
namespace {

// The domain's corner that lies lowest along gravity.
Vec3d lowest_point(const Scene& scene) {
  Vec3d corner;
  for (int axis = 0; axis < 3; ++axis) {
    corner[axis] = scene.gravity[axis] <= 0 ? scene.domain.min[axis] : scene.domain.max[axis];
  }
  return corner;
}

struct Sums {
  double speed2 = 0, spin2 = 0, fall = 0;
  Vec3d velocity, moment;
  double max_speed2 = 0;
  void operator+=(const Sums& other) {
    speed2 += other.speed2;
    spin2 += other.spin2;
    fall += other.fall;
    velocity += other.velocity;
    moment += other.moment;
    max_speed2 = std::max(max_speed2, other.max_speed2);
  }
};

}  // namespace

Diagnostics diagnose(const World& world) {
  const Vec3d low = lowest_point(world.scene), g = world.scene.gravity;
  const bool spins = !world.fields.microrotation.empty();
  const auto sums = ordered_sum<Sums>(world.count, [&](std::size_t begin, std::size_t end) {
    Sums part;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3d x = to_double(world.fields.position[i]), v = to_double(world.fields.velocity[i]);
      const Vec3d omega = spins ? to_double(world.fields.microrotation[i]) : Vec3d{};
      part += {dot(v, v), dot(omega, omega), dot(g, x - low), v, cross(x, v), dot(v, v)};
    }
    return part;
  });
  const double m = world.mass;
  const double theta = world.parameters().micropolar.theta;
  return {m / 2 * sums.speed2, m / 2 * theta * sums.spin2, -m * sums.fall, m * sums.velocity,
          m * sums.moment,     std::sqrt(sums.max_speed2)};
}

double kinetic_energy(const World& world) {
  return double{world.mass} / 2 * particle_sum(world.count, [&](std::size_t i) {
           const Vec3d v = to_double(world.fields.velocity[i]);
           return dot(v, v);
         });
}

double rotational_energy(const World& world) {
  const Array<Vec3>& spin = world.fields.microrotation;
  if (spin.empty()) return 0;
  return world.parameters().micropolar.theta * double{world.mass} / 2 * particle_sum(world.count, [&](std::size_t i) {
           const Vec3d omega = to_double(spin[i]);
           return dot(omega, omega);
         });
}

double enstrophy(const World& world) {
  return double{world.mass} / 2 * particle_sum(world.count, [&](std::size_t i) {
           const Vec3d omega = to_double(world.fields.vorticity[i]);
           return dot(omega, omega) / double{world.fields.density[i]};
         });
}

double helicity(const World& world) {
  return double{world.mass} * particle_sum(world.count, [&](std::size_t i) {
           const Vec3d omega = to_double(world.fields.vorticity[i]), v = to_double(world.fields.velocity[i]);
           return dot(omega, v) / double{world.fields.density[i]};
         });
}

std::int64_t count_outside(const World& world) {
  const Domain& domain = world.scene.domain;
  const int dimension = world.scene.dimension;
  const auto beyond_wall = [&](Vec3 x) {
    for (int axis = 0; axis < dimension; ++axis) {
      if (domain.periodic[axis]) continue;
      const bool closed_low = domain.walls[2 * axis].kind != WallKind::open;
      const bool closed_high = domain.walls[2 * axis + 1].kind != WallKind::open;
      // Walls stand where single precision puts them, as the solver sees them.
      if (closed_low && !(x[axis] >= static_cast<float>(domain.min[axis]))) return true;
      if (closed_high && !(x[axis] <= static_cast<float>(domain.max[axis]))) return true;
    }
    return false;
  };
  return static_cast<std::int64_t>(particle_sum(world.count, [&](std::size_t i) {
    const Vec3 x = world.fields.position[i];
    return beyond_wall(x) || world.obstacles->contains(x, world.body_places) ? 1.0 : 0.0;
  }));
}

}  // namespace curlew
