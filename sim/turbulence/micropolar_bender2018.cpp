#include "sim/turbulence/micropolar_bender2018.h"

#include <cmath>
#include <limits>

#include "sim/core/parallel.h"

namespace curlew {
namespace {

using Micropolar = MicropolarParameters;

bool is_full(const Parameters& p) { return p.micropolar.model == Micropolar::model_t::full; }

void count_sweep(World& world) {
  ++world.work.sweeps;
  world.work.pair_visits += world.neighbours.pairs();
}

}  // namespace

double transfer_coefficient(const Parameters& p) { return p.micropolar.nu_t + (is_full(p) ? p.viscosity.nu : 0.0); }

void micropolar_force(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const float strength = static_cast<float>(transfer_coefficient(world.parameters())) * world.mass;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 omega = f.microrotation[i];
      f8 x{}, y{}, z{};
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        const Vec8 other = gather(f.microrotation.data(), p.j);
        const f8 wx = omega.x - other.x, wy = omega.y - other.y, wz = omega.z - other.z;
        const f8 slope = world.kernel.slope(p.r2);
        x += slope * (wy * p.z - wz * p.y);
        y += slope * (wz * p.x - wx * p.z);
        z += slope * (wx * p.y - wy * p.x);
      });
      f.acceleration[i] += strength / f.density[i] * Vec3{sum(x), sum(y), sum(z)};
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
      f8 curl_x{}, curl_y{}, curl_z{}, x{}, y{}, z{};
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& pairs) {
        const Vec8 u = gather(f.velocity.data(), pairs.j), w = gather(f.microrotation.data(), pairs.j);
        const f8 vx = v.x - u.x, vy = v.y - u.y, vz = v.z - u.z;
        const f8 slope = world.kernel.slope(pairs.r2);
        curl_x += slope * (vy * pairs.z - vz * pairs.y);
        curl_y += slope * (vz * pairs.x - vx * pairs.z);
        curl_z += slope * (vx * pairs.y - vy * pairs.x);
        const f8 densities = f.density[i] + gather(f.density.data(), pairs.j);
        const f8 pull =
            (smoothing * world.kernel.value(pairs.r2) - diffusion * slope * pairs.r2 / (pairs.r2 + softening)) /
            densities;
        x += pull * (w.x - omega.x);
        y += pull * (w.y - omega.y);
        z += pull * (w.z - omega.z);
      });
      const Vec3 half_curl = 0.5f * world.mass / f.density[i] * Vec3{sum(curl_x), sum(curl_y), sum(curl_z)};
      f.acceleration[i] = half_curl + kept * (omega + Vec3{sum(x), sum(y), sum(z)} - half_curl);
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
