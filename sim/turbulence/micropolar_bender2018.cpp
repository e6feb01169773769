#include "sim/turbulence/micropolar_bender2018.h"

#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/parallel.h"
#include "sim/sph/velocity_gradient.h"
#include "sim/turbulence/energy_guard.h"

namespace curlew {
namespace {

using Micropolar = MicropolarParameters;

bool is_full(const Parameters& p) { return p.micropolar.model == Micropolar::model_t::full; }

}  // namespace

double transfer_coefficient(const Parameters& p) { return p.micropolar.nu_t + (is_full(p) ? p.viscosity.nu : 0.0); }

namespace {

using Curls = Micropolar::curls_t;

// What of a step is the same for all particles.
struct Step {
  float transfer;              // of curl omega, m^2/s
  float kept, gained;          // shares of the distance to equilibrium and, for the torque, 1/m^2 of what it adds
  float diffusion, smoothing;  // of the pulls between spins, times mass
  Vec3 torque;
};

Step step_of(const World& world) {
  const Micropolar& p = world.parameters().micropolar;
  const double transfer = transfer_coefficient(world.parameters()), dt = world.dt, rate = 2 * transfer / p.theta;
  const double kept = std::exp(-rate * dt), gained = -std::expm1(-rate * dt) / (rate * p.theta);
  // Twice: of a pair's two densities the mean counts, so that both lose and gain the same.
  const double zeta = is_full(world.parameters()) ? p.zeta / p.theta : 0.0;
  const bool by_rate = p.xsph_form == Micropolar::xsph_form_t::rate;
  const double smoothing = 2 * p.eta * (by_rate ? dt / p.xsph_reference_step : 1.0);
  return {static_cast<float>(transfer),
          static_cast<float>(kept),
          static_cast<float>(gained),
          static_cast<float>(2 * 2 * zeta * dt) * world.mass,
          static_cast<float>(smoothing) * world.mass,
          to_float({p.torque_x, p.torque_y, p.torque_z})};
}

Vec8 scaled(f8 by, const Vec8& a) { return {by * a.x, by * a.y, by * a.z, a.w}; }

template <Curls curls>
void couple(World& world) {
  Fields& f = world.fields;
  const Step step = step_of(world);
  const float softening = world.kernel.softening();
  const bool bodies = !f.no_slip_gradient.empty();
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 v = f.velocity[i], omega = f.microrotation[i];
      const float density = omega.w;
      VectorSum curl_v, curl_omega, pulls;
      const auto add = [&](f8 slope, f8 value, const Vec8& u, const Vec8& w, const Pairs& p) {
        if constexpr (curls == Curls::symmetric) {
          const f8 there = 1.0f / (w.w * w.w);
          const float here = 1 / (density * density);
          curl_v.add_curl_symmetric(slope, here * v, scaled(there, u), p);
          curl_omega.add_curl_symmetric(slope, here * omega, scaled(there, w), p);
        } else {
          curl_v.add_curl(slope, v, u, p);
          if constexpr (curls == Curls::difference) curl_omega.add_curl(slope, omega, w, p);
          if constexpr (curls == Curls::conjugate) {
            curl_omega.add_curl_symmetric(slope, 1 / density * omega, scaled(1.0f / w.w, w), p);
          }
        }
        const f8 spread = step.diffusion * slope * p.r2 / (p.r2 + softening);
        const f8 pull = (step.smoothing * value - spread) / (density + w.w);
        pulls.add(pull * (w.x - omega.x), pull * (w.y - omega.y), pull * (w.z - omega.z));
      };
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        add(world.kernel.slope(p.r2), world.kernel.value(p.r2), gather(f.velocity.data(), p.j),
            gather(f.microrotation.data(), p.j), p);
      });
      for_reflected_pairs(world, i, images, [&](const Pairs& p, f8 weight, const Reflection& r) {
        add(weight * world.kernel.slope(p.r2), f8{},
            reflect(gather(f.velocity.data(), p.j), r.velocity_sign, r.velocity_offset),
            reflect(gather(f.microrotation.data(), p.j), r.spin_sign, {}), p);
      });
      // The factor before each sum: volume, or mass and density.
      const float of_v = world.mass * (curls == Curls::symmetric ? density : 1 / density);
      const float of_omega = world.mass * (curls == Curls::symmetric    ? density
                                           : curls == Curls::difference ? 1 / density
                                                                        : 1.0f);
      Vec3 flow = of_v * curl_v.total(), spin = of_omega * curl_omega.total();
      if (bodies) {
        flow += 1 / density * no_slip_curl(f, i, v);
        spin += 1 / density * cross(omega, f.no_slip_gradient[i]);
      }
      push(f, i, step.transfer * spin);
      const Vec3 half = 0.5f * flow;
      f.packed[i] = half + step.kept * (omega + pulls.total() - half) + step.gained * step.torque;
    });
  });
}

}  // namespace

void couple_spin_and_flow(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  // A neighbour's density comes with its spin.
  parallel_for(world.count, [&](std::size_t i) { f.microrotation[i].w = f.density[i]; });
  switch (world.parameters().micropolar.curls) {
    case Curls::difference:
      couple<Curls::difference>(world);
      break;
    case Curls::symmetric:
      couple<Curls::symmetric>(world);
      break;
    case Curls::conjugate:
      couple<Curls::conjugate>(world);
      break;
  }
  std::swap(f.microrotation, f.packed);  // the spin before stays in packed, for the energy guard
}

double micropolar_step_limit(const World& world) {
  const Parameters& all = world.parameters();
  const Micropolar& p = all.micropolar;
  const double d = world.scene.spacing(), coupling = std::abs(transfer_coefficient(all));
  double dt = std::numeric_limits<double>::max();
  if (coupling == 0) return dt;
  // Spin and flow exchange at the rate c k / sqrt(Theta), with k = 1/d at most or so, and where Theta is so small that
  // the spin follows the flow at once, flow grows or decays at c k^2 / 2.
  dt = std::max(0.5 * std::sqrt(p.theta) * d / coupling, 0.25 * d * d / coupling);
  if (is_full(all) && p.zeta > 0) dt = std::min(dt, all.time.viscosity_factor * d * d * p.theta / p.zeta);
  if (p.xsph_form == Micropolar::xsph_form_t::rate && p.eta > 0) dt = std::min(dt, 0.5 * p.xsph_reference_step / p.eta);
  return dt;
}

}  // namespace curlew
