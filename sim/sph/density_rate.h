// The rate at which a velocity changes the density, which both pressure solves take out, plain and corrected.
#pragma once

#include "sim/sph/velocity_gradient.h"

namespace curlew {

// A source that no pressure answers: the particle takes no part in a solve.
inline constexpr float no_part = -1e30f;

// What bodies add to the density's gradient: all that walls do not.
inline Vec3 body_gradient(const World& world, std::size_t i) {
  if (world.bodies.count() == 0) return {};
  return world.fields.boundary_gradient[i] - world.walls.sum(world.fields.position[i]).gradient;
}

// What the motion of bodies takes off D_i below, v the velocity of the fluid: sum rho_0 V_b v_b . grad W_ib.
inline float body_rate(const World& world, std::size_t i) {
  return world.fields.body_motion.empty() ? 0.0f : world.fields.body_motion[i].w;
}

// D_i(v): rate of change of density, kg/(m^3 s), beside bodies at rest.
template <class Images>
float density_rate(const World& world, const Array<Vec3>& v, std::size_t i, const Images& images, bool boundary) {
  const Vec3 own = v[i];
  f8 rate{};
  for_pairs(world.neighbours, world.fields.position.data(), i, images, [&](const Pairs& p) {
    const Vec8 other = gather(v.data(), p.j);
    rate += world.kernel.slope(p.r2) * ((own.x - other.x) * p.x + (own.y - other.y) * p.y + (own.z - other.z) * p.z);
  });
  const float fluid = world.mass * sum(rate);
  return boundary ? fluid + dot(own, world.fields.boundary_gradient[i]) : fluid;
}

// The same with the kernel-gradient correction B: sum m (v_i - v_j) . B grad W_ij, exact for a linear velocity on any
// arrangement.
template <class Images>
float corrected_density_rate(const World& world, const Array<Vec3>& v, std::size_t i, const Images& images) {
  const Vec3 own = v[i], b = world.fields.correction_diagonal[i], c = world.fields.correction_mixed[i];
  f8 rate{};
  const auto add = [&](f8 slope, const Vec8& other, const Pairs& p) {
    const f8 x = b.x * p.x + c.z * p.y + c.y * p.z, y = c.z * p.x + b.y * p.y + c.x * p.z,
             z = c.y * p.x + c.x * p.y + b.z * p.z;
    rate += slope * ((own.x - other.x) * x + (own.y - other.y) * y + (own.z - other.z) * z);
  };
  for_pairs(world.neighbours, world.fields.position.data(), i, images,
            [&](const Pairs& p) { add(world.kernel.slope(p.r2), gather(v.data(), p.j), p); });
  for_reflected_pairs(world, i, images, [&](const Pairs& p, f8 weight, const Reflection& r) {
    add(weight * world.kernel.slope(p.r2), reflect(gather(v.data(), p.j), r.sign, {}), p);
  });
  const float fluid = world.mass * sum(rate);
  return fluid + dot(own, body_gradient(world, i));
}

}  // namespace curlew
