// Derivatives of the velocity at one particle, in the difference form (Liu et al. 2020, Eq. 3, 6). Walls count as the
// fluid's reflections in them; in the curl no-slip bodies count as samples with the body's velocity, in the gradient,
// which is corrected for missing neighbours instead, bodies do not.
#pragma once

#include "sim/sph/pair_sums.h"

namespace curlew {

// Calls body(pairs, weight, reflection) for the neighbours of particle i as walls reflect them, itself among them;
// weight is 1, and 0 for what fills a group up. Where no wall is near it costs a look at each face.
template <class Images, class Body>
inline void for_reflected_pairs(const World& world, std::size_t i, const Images& images, Body&& body) {
  if (!world.walls.any()) return;
  Reflection reflections[Walls::most_reflections];
  const int number = world.walls.reflections(world.fields.position[i], reflections);
  for (int k = 0; k < number; ++k) {
    const Reflection& r = reflections[k];
    const auto reflected = [&](Pairs p) {
      p.x = r.sign.x * p.x + r.offset.x;
      p.y = r.sign.y * p.y + r.offset.y;
      p.z = r.sign.z * p.z + r.offset.z;
      p.r2 = p.x * p.x + p.y * p.y + p.z * p.z;
      return p;
    };
    for_pairs(world.neighbours, world.fields.position.data(), i, images,
              [&](const Pairs& p) { body(reflected(p), p.r2 > 0.0f ? splat(1.0f) : f8{}, r); });
    const auto self = static_cast<std::uint32_t>(i);
    const std::uint32_t selves[8] = {self, self, self, self, self, self, self, self};
    const f8 none{};
    body(reflected(Pairs{none, none, none, none, none, selves}), f8{1}, r);
  }
}

// The velocities of reflected neighbours.
inline Vec8 reflect(const Vec8& v, Vec3 sign, Vec3 offset) {
  return {sign.x * v.x + offset.x, sign.y * v.y + offset.y, sign.z * v.z + offset.z, v.w};
}

// Calls body(slope, velocities, pairs) for the neighbours of particle i and for their reflections.
template <class Images, class Body>
inline void for_neighbour_velocities(const World& world, std::size_t i, const Images& images, Body&& body) {
  const Fields& f = world.fields;
  for_pairs(world.neighbours, f.position.data(), i, images,
            [&](const Pairs& p) { body(world.kernel.slope(p.r2), gather(f.velocity.data(), p.j), p); });
  for_reflected_pairs(world, i, images, [&](const Pairs& p, f8 weight, const Reflection& r) {
    body(weight * world.kernel.slope(p.r2), reflect(gather(f.velocity.data(), p.j), r.velocity_sign, r.velocity_offset),
         p);
  });
}

// What no-slip bodies add to rho curl v.
inline Vec3 no_slip_curl(const Fields& f, std::size_t i, Vec3 v) {
  const Vec3 at_rest = cross(v, f.no_slip_gradient[i]);
  return f.body_motion.empty() ? at_rest : at_rest - f.body_motion[i];
}

// curl v (1/s).
template <class Images>
Vec3 velocity_curl(const World& world, std::size_t i, const Images& images) {
  const Fields& f = world.fields;
  const Vec3 v = f.velocity[i];
  VectorSum curl;
  for_neighbour_velocities(world, i, images,
                           [&](f8 slope, const Vec8& other, const Pairs& p) { curl.add_curl(slope, v, other, p); });
  Vec3 total = world.mass * curl.total();
  if (!f.no_slip_gradient.empty()) total += no_slip_curl(f, i, v);
  return 1 / f.density[i] * total;
}

// The gradients of v_x, v_y and v_z (1/s), and how well the particle is surrounded: 1 in the midst of fluid and at a
// wall, less at a surface.
struct VelocityGradient {
  Vec3 x, y, z;
  float surrounded = 0;

  Vec3 curl() const { return {z.y - y.z, x.z - z.x, y.x - x.y}; }
  float divergence() const { return x.x + y.y + z.z; }
  // (a . grad) v
  Vec3 along(Vec3 a) const { return {dot(a, x), dot(a, y), dot(a, z)}; }
};

// Sums for the velocity gradient and for the moments - sum V_j grad W_ij (x) x_ij of the neighbours, with which it is
// made exact for linear fields on any arrangement (Randles & Libersky 1996; Bonet & Lok 1999).
struct GradientSum {
  VectorSum x, y, z;
  VectorSum moments, mixed;  // xx, yy, zz; yz, zx, xy

  void add(f8 slope, Vec3 v, const Vec8& other, const Pairs& p) {
    const f8 sx = slope * p.x, sy = slope * p.y, sz = slope * p.z;
    const f8 vx = other.x - v.x, vy = other.y - v.y, vz = other.z - v.z;
    x.add(vx * sx, vx * sy, vx * sz);
    y.add(vy * sx, vy * sy, vy * sz);
    z.add(vz * sx, vz * sy, vz * sz);
    moments.add(sx * p.x, sy * p.y, sz * p.z);
    mixed.add(sy * p.z, sz * p.x, sx * p.y);
  }
};

template <class Images>
VelocityGradient velocity_gradient(const World& world, std::size_t i, const Images& images) {
  const Fields& f = world.fields;
  const Vec3 v = f.velocity[i];
  GradientSum sums;
  for_neighbour_velocities(world, i, images,
                           [&](f8 slope, const Vec8& other, const Pairs& p) { sums.add(slope, v, other, p); });
  const float volume = world.mass / f.density[i];
  const Vec3 moments = -volume * sums.moments.total(), mixed = -volume * sums.mixed.total();
  const Correction correction = gradient_correction(moments, mixed, world.scene.dimension);
  const auto corrected = [&](const VectorSum& s) { return volume * (correction.matrix * s.total()); };
  return {corrected(sums.x), corrected(sums.y), corrected(sums.z), correction.determinant};
}

}  // namespace curlew
