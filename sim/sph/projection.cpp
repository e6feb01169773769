#include "sim/sph/projection.h"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"
#include "sim/sph/density_rate.h"

namespace curlew {
namespace {

// Compression in a step below which float differences of velocities are noise.
constexpr double round_off = 3e-7;

// a(k) with the kernel-gradient correction: a_i = -sum m (k_i B_i + k_j B_j) grad W_ij, the adjoint of the
// corrected density rate. Only then does the solve project: it takes the least from the velocity that leaves it free of
// divergence. With the plain sum for a, it took 2.4 times as much from Taylor-Green vortices.
void accelerate_corrected(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const float k = f.packed[i].w;
      const Vec3 b = k * f.correction_diagonal[i], c = k * f.correction_mixed[i];
      VectorSum push;
      const auto add = [&](f8 slope, f8 pressure, const Pairs& p, Vec3 mixed_sign) {
        const Vec8 d = gather(f.correction_diagonal.data(), p.j), e = gather(f.correction_mixed.data(), p.j);
        const f8 xx = b.x + pressure * d.x, yy = b.y + pressure * d.y, zz = b.z + pressure * d.z;
        const f8 yz = c.x + mixed_sign.x * pressure * e.x, zx = c.y + mixed_sign.y * pressure * e.y,
                 xy = c.z + mixed_sign.z * pressure * e.z;
        push.add(slope * (xx * p.x + xy * p.y + zx * p.z), slope * (xy * p.x + yy * p.y + yz * p.z),
                 slope * (zx * p.x + yz * p.y + zz * p.z));
      };
      for_pairs(world.neighbours, f.packed.data(), i, images, [&](const Pairs& p) {
        add(world.kernel.slope(p.r2), p.w, p, {1, 1, 1});
      });
      for_reflected_pairs(world, i, images, [&](const Pairs& p, f8 weight, const Reflection& r) {
        const Vec3 s = r.sign;
        add(weight * world.kernel.slope(p.r2), gather(f.packed.data(), p.j).w, p, {s.y * s.z, s.z * s.x, s.x * s.y});
      });
      f.acceleration[i] = -world.mass * push.total() - k * body_gradient(world, i);
    });
  });
}

// What has no part answers with no rate.
template <class Use>
void rates_of_acceleration(World& world, Use&& use) {
  count_sweep(world);
  const Fields& f = world.fields;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      if (f.source[i] != no_part) use(i, corrected_density_rate(world, f.acceleration, i, images));
    });
  });
}

// r . M r, M the inverse of the diagonal; r stands in the field source.
double preconditioned_square(const World& world) {
  const Fields& f = world.fields;
  return particle_sum(world.count, [&](std::size_t i) {
    const float r = f.source[i];
    return r == no_part ? 0.0 : double{r} * r / f.corrected_diagonal[i];
  });
}

// v += share dt a, a the acceleration by the divergence solve of this step.
void push_again(World& world, double share) {
  Fields& f = world.fields;
  const auto time = static_cast<float>(share * world.dt);
  parallel_for(world.count, [&](std::size_t i) { f.velocity[i] += time * f.pressure_acceleration[i]; });
}

}  // namespace

PressureSolution project(World& world) {
  Fields& f = world.fields;
  const PressureParameters& p = world.parameters().pressure;
  // Less than at a flat surface. Disorder reaches 0.9, and there round-off would decide who takes part.
  const float full = 0.75f * world.rest_density();
  const double scale = world.dt * world.dt / (static_cast<double>(world.count) * world.rest_density());
  // Of expansion there is as much as of compression, and of both half is counted.
  const auto compression = [&] {
    return 0.5 * scale * particle_sum(world.count, [&](std::size_t i) {
             return f.source[i] == no_part ? 0.0 : std::abs(double{f.source[i]});
           });
  };
  parallel_for(world.count, [&](std::size_t i) {
    if (f.density[i] < full) f.source[i] = no_part;
  });
  const double tolerance = std::min(p.divergence_tolerance, std::max(p.relative_tolerance * compression(), round_off));

  // k stands in the stiffness, the residual in the source, the direction in packed.w and what it does in iterate.
  Array<float>& k = f.divergence_stiffness;
  parallel_for(world.count, [&](std::size_t i) {
    if (!p.warm_start || f.source[i] == no_part) k[i] = 0;
    f.packed[i] = f.position[i];
    f.packed[i].w = k[i];
  });
  if (p.warm_start) {
    accelerate_corrected(world);
    rates_of_acceleration(world, [&](std::size_t i, float rate) { f.source[i] += rate; });
  }
  const auto turn = [&](float share) {
    parallel_for(world.count, [&](std::size_t i) {
      const float r = f.source[i];
      f.packed[i].w = r == no_part ? 0.0f : r / f.corrected_diagonal[i] + share * f.packed[i].w;
    });
  };
  turn(0);
  PressureSolution solution{1, compression()};
  double square = preconditioned_square(world);
  while ((solution.error > tolerance || solution.iterations < p.min_iterations) &&
         solution.iterations < p.max_divergence_iterations && square > 0) {
    accelerate_corrected(world);
    rates_of_acceleration(world, [&](std::size_t i, float rate) { f.iterate[i] = -rate; });
    const double energy = particle_sum(world.count, [&](std::size_t i) {
      return f.source[i] == no_part ? 0.0 : double{f.packed[i].w} * f.iterate[i];
    });
    if (!(energy > 0)) break;
    const auto length = static_cast<float>(square / energy);
    parallel_for(world.count, [&](std::size_t i) {
      if (f.source[i] == no_part) return;
      k[i] += length * f.packed[i].w;
      f.source[i] -= length * f.iterate[i];
    });
    const double last = square;
    square = preconditioned_square(world);
    turn(static_cast<float>(square / last));
    solution.error = compression();
    ++solution.iterations;
  }
  if (solution.error > tolerance) ++world.report.limit_hits;
  parallel_for(world.count, [&](std::size_t i) { f.packed[i].w = k[i]; });
  accelerate_corrected(world);
  return solution;
}

void midpoint_velocity(World& world) { push_again(world, 0.5 * (1 + world.parameters().pressure.reflection)); }

void reflect_velocity(World& world) { push_again(world, 0.5 * (world.parameters().pressure.reflection - 1)); }

}  // namespace curlew
