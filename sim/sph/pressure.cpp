#include "sim/sph/pressure.h"

#include <cmath>

#include "sim/core/parallel.h"
#include "sim/sph/density_rate.h"
#include "sim/sph/projection.h"

namespace curlew {
namespace {

// Of the Jacobi move: one half converges on any arrangement that was met (Bender & Koschier 2017 use the same). The
// largest eigenvalue of the scaled operator is about 2.8 in splashing water, and momentum needs the factor times it
// below 4/3: 0.42 is the fastest that was seen to be safe. On the dam break, 24k particles, 0.6 s, the density solve
// takes 14.5 iterations a step with Jacobi and 7.4 with momentum; Barzilai-Borwein steps took 6.7 but two more arrays,
// conjugate gradients with projection 10 to 12.
constexpr float jacobi_relaxation = 0.5f, momentum_relaxation = 0.4f;

struct Solve {
  Array<float>& stiffness;
  double tolerance;  // mean compression, as a fraction
  int max_iterations;
  bool corrected = false;  // the divergence
};

// a(k) for the iterate in packed.w, into the field acceleration.
void accelerate(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const bool boundary = world.has_boundary();
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const float k = f.packed[i].w;
      f8 x{}, y{}, z{};
      for_pairs(world.neighbours, f.packed.data(), i, images, [&](const Pairs& p) {
        const f8 push = (k + p.w) * world.kernel.slope(p.r2);
        x += push * p.x;
        y += push * p.y;
        z += push * p.z;
      });
      Vec3 a = -world.mass * Vec3{sum(x), sum(y), sum(z)};
      if (boundary) a += -k * f.boundary_gradient[i];
      f.acceleration[i] = a;
    });
  });
}

struct Progress {
  double error = 0;     // sum of positive residuals: compression that is left
  double excess = 0;    // sum of negative residuals that less pressure would remove: expansion that k causes
  double momentum = 0;  // residual along the last move: negative when momentum leads uphill
  void operator+=(const Progress& other) {
    error += other.error;
    excess += other.excess;
    momentum += other.momentum;
  }
};

// Scales the warm start in packed.w and iterate, and its acceleration, to the multiple s of itself with the least
// J(s) = -s sum k source + s^2/2 sum |a|^2. In the divergence solve J is the kinetic energy that k adds, and a warm
// start that no longer fits, after an impact or a jump of the time step, pushes energy in and may still lie within the
// tolerance: the dam break gained 0.4 % in 0.14 s. Where 1/2 < s < 1 nothing is gained, and the solve that follows
// sorts out particle by particle what to take back in fewer iterations (6.9 against 7.9 a step).
void scale_warm_start(World& world) {
  Fields& f = world.fields;
  struct Sums {
    double work = 0, square = 0;
    void operator+=(const Sums& other) {
      work += other.work;
      square += other.square;
    }
  };
  const Sums sums = ordered_sum<Sums>(world.count, [&](std::size_t begin, std::size_t end) {
    Sums part;
    for (std::size_t i = begin; i < end; ++i) {
      const float k = f.packed[i].w;
      if (k != 0) part.work += double{k} * f.source[i];
      part.square += dot(f.acceleration[i], f.acceleration[i]);
    }
    return part;
  });
  if (sums.square <= 0) return;
  const auto scale = static_cast<float>(std::max(0.0, sums.work / sums.square));
  if (scale > 0.5f && scale < 1) return;
  parallel_for(world.count, [&](std::size_t i) {
    f.packed[i].w *= scale;
    f.iterate[i] *= scale;
    f.acceleration[i] = scale * f.acceleration[i];
  });
}

// One sweep: the residual at the iterate in packed.w, and the relaxed Jacobi move from there. Leaves the iterate in
// `stiffness` and the moved value in packed.w.
Progress relax(World& world, const Solve& solve, float relaxation) {
  count_sweep(world);
  Fields& f = world.fields;
  const bool boundary = world.has_boundary();
  const bool two_sided = world.parameters().pressure.two_sided;
  const float full = 0.9f * world.rest_density();
  Progress total;
  with_images(world.cells, [&](auto images) {
    total = ordered_sum<Progress>(world.count, [&](std::size_t begin, std::size_t end) {
      Progress part;
      for (std::size_t i = begin; i < end; ++i) {
        const float k = f.packed[i].w, source = f.source[i];
        solve.stiffness[i] = k;
        if (source == no_part) continue;
        const float residual = source + (solve.corrected ? corrected_density_rate(world, f.acceleration, i, images)
                                                         : density_rate(world, f.acceleration, i, images, boundary));
        const float lowest = two_sided && f.density[i] >= full ? -INFINITY : 0.0f;
        const float moved = std::max(lowest, k + relaxation * residual / f.diagonal[i]);
        part.error += std::max(0.0f, residual);
        part.excess += std::max(0.0f, lowest < 0 ? -residual : std::min(-residual, k * f.diagonal[i]));
        part.momentum += double{residual} * (moved - f.iterate[i]);
        f.packed[i].w = moved;
      }
      return part;
    });
  });
  return total;
}

// Adds Nesterov's momentum to the moved values in packed.w and remembers them.
void extrapolate(World& world, float momentum) {
  Fields& f = world.fields;
  const bool two_sided = world.parameters().pressure.two_sided;
  const float full = 0.9f * world.rest_density();
  parallel_for(world.count, [&](std::size_t i) {
    const float moved = f.packed[i].w;
    const float lowest = two_sided && f.density[i] >= full ? -INFINITY : 0.0f;
    f.packed[i].w = std::max(lowest, moved + momentum * (moved - f.iterate[i]));
    f.iterate[i] = moved;
  });
}

void accelerate_particles(World& world) {
  const auto dt = static_cast<float>(world.dt);
  parallel_for(world.count, [&](std::size_t i) { world.fields.velocity[i] += dt * world.fields.acceleration[i]; });
}

// Finds k for the given source; leaves it in solve.stiffness and a(k) in the field acceleration.
PressureSolution solve_pressure(World& world, const Solve& solve) {
  Fields& f = world.fields;
  const PressureParameters& p = world.parameters().pressure;
  const bool accelerated = p.solver == PressureParameters::solver_t::accelerated;
  const double scale = world.dt * world.dt / (static_cast<double>(world.count) * world.rest_density());
  parallel_for(world.count, [&](std::size_t i) {
    const float k = p.warm_start && f.source[i] != no_part ? solve.stiffness[i] : 0.0f;
    f.packed[i] = f.position[i];
    f.packed[i].w = k;
    f.iterate[i] = k;
  });
  PressureSolution outcome;
  float relaxation = accelerated ? momentum_relaxation : jacobi_relaxation;
  double t = 1, least = INFINITY;
  bool more = true;
  while (more && outcome.iterations < solve.max_iterations) {
    accelerate(world);
    if (p.warm_start && outcome.iterations == 0) scale_warm_start(world);
    const Progress progress = relax(world, solve, relaxation);
    outcome.error = progress.error * scale;
    ++outcome.iterations;
    // Both halves of "r <= 0, k >= 0, one of the two zero". With the first alone a warm start that pushes too hard
    // passes at once, and its push is energy from nowhere: a tank at rest explodes within a second.
    more = outcome.error > solve.tolerance || progress.excess * scale > solve.tolerance ||
           outcome.iterations < p.min_iterations;
    // O'Donoghue & Candes (2015): forget the momentum where it leads uphill. Where things get worse all the same, some
    // cluster has an eigenvalue beyond those that were met: smaller moves for the rest of this solve.
    const double wrong = progress.error + progress.excess;
    if (wrong > 2 * least) relaxation = std::max(0.7f * relaxation, 0.1f);
    if (progress.momentum < 0 || wrong > 2 * least) t = 1;
    least = std::min(least, wrong);
    const double next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    extrapolate(world, accelerated ? static_cast<float>((t - 1) / next) : 0.0f);
    t = next;
  }
  if (more) ++world.report.limit_hits;
  return outcome;
}

// How the density solve takes short steps. There its tolerance alone would let gravity itself pass: the solve ends
// after one iteration, and the warm start, step after step, sums up errors in a force that acts on them with a delay,
// which makes them grow. A dam break (spacing 33 mm) at 0.25 ms won 12 % of its energy in 0.1 s so, and at 0.125 ms it
// flew apart. So it stops at what an acceleration that differs by 0.3 g from a particle to the next brings about in the
// step; half of that costs an iteration more and changes nothing. And compression that is there already is taken back
// not in one step, which would throw particles apart the faster the shorter it is, but in the time of the shortest step
// that is not short.
struct DensityTarget {
  double tolerance;  // mean compression at which the solve stops
  float share;       // of the compression that is there which goes in this step
};

DensityTarget density_target(const World& world) {
  const PressureParameters& p = world.parameters().pressure;
  const double tolerance = p.density_tolerance, gravity = length(world.scene.gravity);
  if (p.two_sided || gravity == 0) return {tolerance, 1};  // two-sided, the solve moves places: no force sums up
  const double passes = 0.3 * gravity * world.dt * world.dt / world.scene.spacing();
  if (passes >= tolerance) return {tolerance, 1};
  constexpr double round_off = 1e-7;
  return {std::min(tolerance, std::max(passes, round_off)), static_cast<float>(std::sqrt(passes / tolerance))};
}

// The density against which compression is measured: rest density or, in a filled domain, the mean prediction.
double reference_density(const World& world) {
  if (!world.parameters().pressure.two_sided) return world.parameters().sph.rest_density;
  return particle_sum(world.count, [&](std::size_t i) { return double{world.fields.source[i]}; }) /
         static_cast<double>(world.count);
}

// The share of a pressure gradient that the symmetric sum of `accelerate` sees at a particle, -1/D sum V_j x_ij . grad
// W_ij: 1 on a good lattice, about 0.96 where particles lie in disorder at h = d. k_i times it is the particle's part
// of the virial, which holds the water's weight. At a wall it is that along the wall's normal, with what the wall
// itself adds: in 3D the first layer there bears 11 % more than its depth and sees 7 % less of it. 0 where it is not
// known: at a surface and at bodies.
template <class Images>
float seen_share(const World& world, std::size_t i, const Images& images) {
  const Fields& f = world.fields;
  if (f.density[i] < 0.98f * world.rest_density()) return 0;
  const bool boundary = world.has_boundary() && f.boundary_gradient[i].w > 0;
  if (!boundary) {
    f8 moment{};
    for_pairs(world.neighbours, f.position.data(), i, images,
              [&](const Pairs& p) { moment -= world.kernel.slope(p.r2) * p.r2; });
    return world.mass / f.density[i] * sum(moment) / static_cast<float>(world.scene.dimension);
  }
  const WallSum wall = world.walls.sum(f.position[i]);
  const float size = length(wall.gradient);
  if (!(size > 0) || wall.gradient.w < f.boundary_gradient[i].w) return 0;
  const Vec3 n = 1 / size * wall.gradient;
  f8 moment{};
  for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
    const f8 along = n.x * p.x + n.y * p.y + n.z * p.z;
    moment -= world.kernel.slope(p.r2) * along * along;
  });
  const float by_wall = n.x * n.x * wall.virial.x + n.y * n.y * wall.virial.y + n.z * n.z * wall.virial.z;
  return (world.mass * sum(moment) + by_wall) / f.density[i];
}

// Those shares into the field pressure; where they are not known, their mean, each counting by its pressure.
void find_seen_shares(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  struct Mean {
    double sum = 0, weight = 0;
    void operator+=(const Mean& other) {
      sum += other.sum;
      weight += other.weight;
    }
  };
  Mean mean;
  with_images(world.cells, [&](auto images) {
    mean = ordered_sum<Mean>(world.count, [&](std::size_t begin, std::size_t end) {
      Mean part;
      for (std::size_t i = begin; i < end; ++i) {
        f.pressure[i] = seen_share(world, i, images);
        const double weight = std::abs(double{f.density_stiffness[i]} + f.divergence_stiffness[i]);
        if (f.pressure[i] > 0) part += {weight * f.pressure[i], weight};
      }
      return part;
    });
  });
  const auto usual = mean.weight > 0 ? static_cast<float>(mean.sum / mean.weight) : 1.0f;
  parallel_for(world.count, [&](std::size_t i) {
    if (f.pressure[i] <= 0) f.pressure[i] = usual;
  });
}

// The work of moving bodies, J, where k acts so many times in the step: sum over samples b of F_b . v_b dt with
// F_b = -sum m k_i rho_0 V_b grad W_ib on the fluid.
void count_body_work(World& world, const Array<float>& k, double times) {
  if (world.fields.body_motion.empty()) return;
  world.report.body_work -= times * world.dt * double{world.mass} * particle_sum(world.count, [&](std::size_t i) {
                              return double{k[i]} * body_rate(world, i);
                            });
}

}  // namespace

void divergence_solve(World& world) {
  Fields& f = world.fields;
  const PressureParameters& p = world.parameters().pressure;
  const bool boundary = world.has_boundary();
  const bool corrected = p.two_sided;
  const auto inverse_dt = static_cast<float>(1 / world.dt);
  count_sweep(world);
  double skipped = 0;
  with_images(world.cells, [&](auto images) {
    skipped = particle_sum(world.count, [&](std::size_t i) {
      const bool spray = f.neighbour_number[i] < world.least_neighbours();
      if (spray) {
        f.source[i] = no_part;
        return 1.0;
      }
      const float rate = corrected ? corrected_density_rate(world, f.velocity, i, images)
                                   : density_rate(world, f.velocity, i, images, boundary);
      f.source[i] = inverse_dt * (rate - body_rate(world, i));
      return 0.0;
    });
  });
  world.report.divergence_skipped = skipped / static_cast<double>(world.count);
  const auto outcome = corrected && p.conserving
                           ? project(world)
                           : solve_pressure(world, {f.divergence_stiffness, p.divergence_tolerance,
                                                    p.max_divergence_iterations, corrected});
  accelerate_particles(world);
  count_body_work(world, f.divergence_stiffness, f.pressure_acceleration.empty() ? 1 : 1 + p.reflection);
  if (!f.pressure_acceleration.empty()) {
    parallel_for(world.count, [&](std::size_t i) { f.pressure_acceleration[i] = f.acceleration[i]; });
  }
  world.report.divergence_iterations = outcome.iterations;
  world.report.divergence_error = outcome.error;
}

double divergence_error(const World& world) {
  const Fields& f = world.fields;
  const bool boundary = world.has_boundary(), corrected = world.parameters().pressure.two_sided;
  double sum = 0;
  with_images(world.cells, [&](auto images) {
    sum = particle_sum(world.count, [&](std::size_t i) {
      if (f.neighbour_number[i] < world.least_neighbours()) return 0.0;
      const float rate = corrected ? corrected_density_rate(world, f.velocity, i, images)
                                   : density_rate(world, f.velocity, i, images, boundary);
      return std::max(0.0, double{rate - body_rate(world, i)});
    });
  });
  return world.dt * sum / (static_cast<double>(world.count) * double{world.rest_density()});
}

void density_solve(World& world) {
  Fields& f = world.fields;
  const PressureParameters& p = world.parameters().pressure;
  const bool boundary = world.has_boundary();
  const auto dt = static_cast<float>(world.dt);
  const DensityTarget target = density_target(world);
  const float rest = world.rest_density(), kept = 1 - target.share;
  count_sweep(world);
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const float rate = density_rate(world, f.velocity, i, images, boundary) - body_rate(world, i);
      f.source[i] = f.density[i] - kept * std::max(0.0f, f.density[i] - rest) + dt * rate;
    });
  });
  const auto reference = static_cast<float>(reference_density(world));
  const float scale = 1 / (dt * dt);
  parallel_for(world.count, [&](std::size_t i) { f.source[i] = scale * (f.source[i] - reference); });
  const auto outcome = solve_pressure(world, {f.density_stiffness, target.tolerance, p.max_iterations});
  if (world.parameters().pressure.two_sided) {
    const float dt2 = dt * dt;
    parallel_for(world.count, [&](std::size_t i) { f.displacement[i] = dt2 * f.acceleration[i]; });
  } else {
    accelerate_particles(world);
    count_body_work(world, f.density_stiffness, 1);
  }
  world.report.pressure_iterations = outcome.iterations;
  world.report.density_error_avg = outcome.error;
}

void total_pressure(World& world) {
  Fields& f = world.fields;
  const PressureParameters& p = world.parameters().pressure;
  find_seen_shares(world);
  // In a filled domain the density solve moves places, not velocities, so what it finds is no pressure: counted as one,
  // it made that of Taylor-Green vortices at 50 across 26 % too large. What the conserving divergence solve does acts
  // 1 + theta times in a step, and its gradient is corrected.
  const bool conserving = p.two_sided && p.conserving;
  const float acts = 1 + static_cast<float>(p.reflection);
  parallel_for(world.count, [&](std::size_t i) {
    const float seen = f.pressure[i];
    const float stiffness =
        (p.two_sided ? 0.0f : seen * f.density_stiffness[i]) + (conserving ? acts : seen) * f.divergence_stiffness[i];
    f.pressure[i] = f.density[i] * f.density[i] * stiffness;
  });
}

}  // namespace curlew
