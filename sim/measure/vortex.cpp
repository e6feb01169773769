#include "sim/measure/vortex.h"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"
#include "sim/scene/sampling.h"

namespace curlew {
namespace {

struct Polar {
  double radius, speed;  // speed: around the centre
};

Polar around(Vec3d centre, Vec3d x, Vec3d v) {
  const double dx = x.x - centre.x, dy = x.y - centre.y, r = std::hypot(dx, dy);
  return {r, r > 0 ? (dx * v.y - dy * v.x) / r : 0};
}

}  // namespace

std::vector<ProfileRing> azimuthal_profile(const World& world, const InitialVelocity& exact, double width,
                                           double reach) {
  std::vector<ProfileRing> rings(static_cast<std::size_t>(std::ceil(reach / width)));
  for (std::size_t i = 0; i < world.count; ++i) {
    const Polar p = around(exact.centre, to_double(world.fields.position[i]), to_double(world.fields.velocity[i]));
    const auto ring = static_cast<std::size_t>(p.radius / width);
    if (ring >= rings.size()) continue;
    rings[ring].radius += p.radius;
    rings[ring].measured += p.speed;
    rings[ring].exact += azimuthal_speed(exact, p.radius);
    ++rings[ring].particles;
  }
  std::erase_if(rings, [](const ProfileRing& ring) { return ring.particles == 0; });
  for (ProfileRing& ring : rings) {
    ring.radius /= ring.particles;
    ring.measured /= ring.particles;
    ring.exact /= ring.particles;
  }
  return rings;
}

double peak_retained(const std::vector<ProfileRing>& profile) {
  double measured = 0, exact = 0;
  for (const ProfileRing& ring : profile) {
    measured = std::max(measured, ring.measured);
    exact = std::max(exact, ring.exact);
  }
  return measured / exact;
}

double velocity_error(const World& world, const InitialVelocity& exact, Vec3d centre, double reach) {
  const Fields& f = world.fields;
  const auto sum = [&](auto&& value) {
    return particle_sum(world.count, [&](std::size_t i) {
      const Vec3d x = to_double(f.position[i]);
      return length(x - centre) < reach ? length(value(i, initial_velocity(exact, x, world.scene))) : 0.0;
    });
  };
  return sum([&](std::size_t i, Vec3d right) { return to_double(f.velocity[i]) - right; }) /
         sum([](std::size_t, Vec3d right) { return right; });
}

double flow_amplitude(const World& world, const InitialVelocity& exact) {
  const Fields& f = world.fields;
  const auto sum = [&](auto&& value) {
    return particle_sum(world.count, [&](std::size_t i) {
      const Vec3d right = initial_velocity(exact, to_double(f.position[i]), world.scene);
      return dot(value(i, right), right);
    });
  };
  return sum([&](std::size_t i, Vec3d) { return to_double(f.velocity[i]); }) /
         sum([](std::size_t, Vec3d right) { return right; });
}

double wave_number(const World& world) {
  const Fields& f = world.fields;
  const auto sum = [&](const Array<Vec3>& field) {
    return particle_sum(world.count,
                        [&](std::size_t i) { return double{dot(field[i], field[i])} / double{f.density[i]}; });
  };
  return std::sqrt(sum(f.vorticity) / sum(f.velocity));
}

double micropolar_growth_rate(const MicropolarParameters& p, double k) {
  const double relaxation = p.nu_t / p.theta;
  return -relaxation + std::sqrt(relaxation * relaxation + p.nu_t * p.nu_t * k * k / p.theta);
}

double micropolar_growth(const MicropolarParameters& p, double k, double time) {
  const double up = micropolar_growth_rate(p, k), down = -2 * p.nu_t / p.theta - up;
  return (up * std::exp(down * time) - down * std::exp(up * time)) / (up - down);
}

}  // namespace curlew
