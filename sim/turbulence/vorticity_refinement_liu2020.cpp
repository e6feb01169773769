#include "sim/turbulence/vorticity_refinement_liu2020.h"

#include <cmath>
#include <numbers>

#include "sim/core/parallel.h"
#include "sim/sph/velocity_gradient.h"

namespace curlew {
namespace {

constexpr double cut = 0.995;    // of the support, so that lattice points two spacings off are out for certain
constexpr double closest = 0.5;  // pairs nearer than this, in spacings, count as that far

bool takes_part(const World& world, std::size_t i) {
  return world.fields.neighbour_number[i] >= world.least_neighbours();
}

// dzeta = zeta' - curl v~, with the volume of the particle in w.
void find_loss(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const float volume = world.mass / f.density[i];
      Vec3 loss;
      if (takes_part(world, i) && f.predicted_vorticity[i].w > 0) {
        loss = f.predicted_vorticity[i] - velocity_gradient(world, i, images).curl();
      }
      loss.w = volume;
      f.lost_vorticity[i] = loss;
    });
  });
}

// psi as a sum over neighbours.
void sum_stream_function(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const bool flat = world.scene.dimension == 2;
  const double reach = cut * world.kernel.support(), pi = std::numbers::pi;
  const auto reach2 = static_cast<float>(reach * reach);
  const double nearest_distance = closest * world.scene.spacing();
  const auto nearest2 = static_cast<float>(nearest_distance * nearest_distance);
  const auto strength = static_cast<float>(flat ? -1 / (4 * pi) : 1 / (4 * pi));  // ln r = ln(r^2) / 2
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      VectorSum potential;
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        const Vec8 loss = gather(f.lost_vorticity.data(), p.j);
        const f8 r2 = max(p.r2, splat(nearest2));
        const f8 greens = flat ? natural_log(r2 * (1 / reach2)) : inverse_sqrt(r2);
        const f8 weight = (p.r2 > 0.0f) & (p.r2 < reach2) ? greens * loss.w : f8{};  // a list is padded with r = 0
        potential.add(weight * loss.x, weight * loss.y, weight * loss.z);
      });
      f.stream_function[i] = strength * potential.total();
    });
  });
}

// v += alpha curl psi, in the difference form.
void add_curl_of_stream_function(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const auto alpha = static_cast<float>(world.parameters().vorticity_refinement.alpha);
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      if (!takes_part(world, i)) return;
      const Vec3 psi = f.stream_function[i];
      VectorSum curl;
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        curl.add_curl(world.kernel.slope(p.r2), psi, gather(f.stream_function.data(), p.j), p);
      });
      f.velocity[i] += alpha * world.mass / f.density[i] * curl.total();
    });
  });
}

}  // namespace

void refine_vorticity(World& world) {
  find_loss(world);
  sum_stream_function(world);
  add_curl_of_stream_function(world);
}

void predict_vorticity(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const auto dt = static_cast<float>(world.dt);
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const VelocityGradient gradient = velocity_gradient(world, i, images);
      Vec3 zeta = gradient.curl();
      zeta += dt * gradient.along(zeta);
      zeta.w = 1;
      f.predicted_vorticity[i] = zeta;
    });
  });
}

}  // namespace curlew
