#include "sim/turbulence/micropolar_bender2018.h"

#include <cmath>
#include <limits>

#include "sim/core/parallel.h"
#include "sim/sph/pair_sums.h"

namespace curlew {
namespace {

using Micropolar = MicropolarParameters;

bool is_full(const Parameters& p) { return p.micropolar.model == Micropolar::model_t::full; }

}  // namespace

double transfer_coefficient(const Parameters& p) { return p.micropolar.nu_t + (is_full(p) ? p.viscosity.nu : 0.0); }

void micropolar_force(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const float strength = static_cast<float>(transfer_coefficient(world.parameters())) * world.mass;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 omega = f.microrotation[i];
      VectorSum curl;
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        curl.add_curl(world.kernel.slope(p.r2), omega, gather(f.microrotation.data(), p.j), p);
      });
      f.acceleration[i] += strength / f.density[i] * curl.total();
    });
  });
}

void spin(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const Micropolar& p = world.parameters().micropolar;
  const double coupling = transfer_coefficient(world.parameters()) / p.theta, dt = world.dt;
  const auto kept = static_cast<float>(std::exp(-2 * coupling * dt));
  // Twice: of a pair's two densities the mean counts, so that both lose and gain the same.
  const double zeta = is_full(world.parameters()) ? p.zeta / p.theta : 0.0;
  const float diffusion = static_cast<float>(2 * 2 * zeta * dt) * world.mass, softening = world.kernel.softening();
  const bool rate = p.xsph_form == Micropolar::xsph_form_t::rate;
  const float smoothing = static_cast<float>(2 * p.eta * (rate ? dt / p.xsph_reference_step : 1.0)) * world.mass;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 v = f.velocity[i], omega = f.microrotation[i];
      VectorSum curl, pulls;
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& pairs) {
        const Vec8 w = gather(f.microrotation.data(), pairs.j);
        const f8 slope = world.kernel.slope(pairs.r2);
        curl.add_curl(slope, v, gather(f.velocity.data(), pairs.j), pairs);
        const f8 densities = f.density[i] + gather(f.density.data(), pairs.j);
        const f8 spread = diffusion * slope * pairs.r2 / (pairs.r2 + softening);
        const f8 pull = (smoothing * world.kernel.value(pairs.r2) - spread) / densities;
        pulls.x += pull * (w.x - omega.x);
        pulls.y += pull * (w.y - omega.y);
        pulls.z += pull * (w.z - omega.z);
      });
      const Vec3 half_curl = 0.5f * world.mass / f.density[i] * curl.total();
      f.acceleration[i] = half_curl + kept * (omega + pulls.total() - half_curl);
    });
  });
  parallel_for(world.count, [&](std::size_t i) { f.microrotation[i] = f.acceleration[i]; });
}

double micropolar_step_limit(const World& world) {
  const Parameters& all = world.parameters();
  const Micropolar& p = all.micropolar;
  const double d = world.scene.spacing(), coupling = std::abs(transfer_coefficient(all));
  double dt = std::numeric_limits<double>::max();
  if (coupling == 0) return dt;
  // Spin and flow exchange at the rate (nu + nu_t) k / sqrt(Theta), at most with k = 1/d or so.
  dt = 0.5 * std::sqrt(p.theta) * d / coupling;
  if (is_full(all) && p.zeta > 0) dt = std::min(dt, all.time.viscosity_factor * d * d * p.theta / p.zeta);
  if (p.xsph_form == Micropolar::xsph_form_t::rate && p.eta > 0) dt = std::min(dt, 0.5 * p.xsph_reference_step / p.eta);
  return dt;
}

}  // namespace curlew
