// Derivatives of the velocity at one particle, in the difference form (Liu et al. 2020, Eq. 3, 6), with the surfaces
// near it: beyond a no-slip surface the fluid moves as in a mirror around the surface's velocity, beyond a slip surface
// its normal part does.
#pragma once

#include "sim/sph/pair_sums.h"

namespace curlew {

// What no-slip surfaces add to the curl, times density: a field that is `here`, and `beyond` at the surfaces.
inline Vec3 no_slip_curl(const Fields& f, std::size_t i, Vec3 here, Vec3 beyond) {
  return f.no_slip_gradient.empty() ? Vec3{} : cross(here - beyond, f.no_slip_gradient[i]);
}

// The same for the velocity.
inline Vec3 no_slip_curl(const Fields& f, std::size_t i) {
  return f.no_slip_gradient.empty() ? Vec3{} : no_slip_curl(f, i, f.velocity[i], f.no_slip_velocity[i]);
}

// curl v (1/s).
template <class Images>
Vec3 velocity_curl(const World& world, std::size_t i, const Images& images) {
  const Fields& f = world.fields;
  const Vec3 v = f.velocity[i];
  VectorSum curl;
  for_pairs(world.neighbours, f.position.data(), i, images,
            [&](const Pairs& p) { curl.add_curl(world.kernel.slope(p.r2), v, gather(f.velocity.data(), p.j), p); });
  return 1 / f.density[i] * (world.mass * curl.total() + no_slip_curl(f, i));
}

// The gradients of v_x, v_y and v_z (1/s).
struct VelocityGradient {
  Vec3 x, y, z;

  Vec3 curl() const { return {z.y - y.z, x.z - z.x, y.x - x.y}; }
  // (a . grad) v
  Vec3 along(Vec3 a) const { return {dot(a, x), dot(a, y), dot(a, z)}; }
};

template <class Images>
VelocityGradient velocity_gradient(const World& world, std::size_t i, const Images& images) {
  const Fields& f = world.fields;
  const Vec3 v = f.velocity[i];
  VectorSum x, y, z;
  for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
    const Vec8 other = gather(f.velocity.data(), p.j);
    const f8 slope = world.kernel.slope(p.r2);
    const f8 sx = slope * p.x, sy = slope * p.y, sz = slope * p.z;
    const f8 vx = other.x - v.x, vy = other.y - v.y, vz = other.z - v.z;
    x.add(vx * sx, vx * sy, vx * sz);
    y.add(vy * sx, vy * sy, vy * sz);
    z.add(vz * sx, vz * sy, vz * sz);
  });
  const float volume = world.mass / f.density[i];
  VelocityGradient g{volume * x.total(), volume * y.total(), volume * z.total()};
  if (!world.has_boundary()) return g;
  Vec3 slip = f.boundary_gradient[i];
  if (!f.no_slip_gradient.empty()) {
    const Vec3 rough = f.no_slip_gradient[i], slide = -1 / f.density[i] * (v - f.no_slip_velocity[i]);
    g.x += slide.x * rough;
    g.y += slide.y * rough;
    g.z += slide.z * rough;
    slip = slip - rough;
  }
  const float size2 = dot(slip, slip);
  if (size2 > 0) {
    const Vec3 change = -dot(v, slip) / (size2 * f.density[i]) * slip;
    g.x += change.x * slip;
    g.y += change.y * slip;
    g.z += change.z * slip;
  }
  return g;
}

}  // namespace curlew
