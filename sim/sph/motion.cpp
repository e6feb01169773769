#include "sim/sph/motion.h"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"
#include "sim/sph/moving_bodies.h"
#include "sim/sph/velocity_gradient.h"
#include "sim/turbulence/micropolar_bender2018.h"

namespace curlew {
namespace {

Vec3 gravity_of(const World& world) { return to_float(world.scene.gravity); }

// Steps that speed, acceleration and viscosity allow.
double allowed_step(const World& world, double max_speed, double max_acceleration) {
  const TimeParameters& t = world.parameters().time;
  const double d = world.scene.spacing(), nu = world.parameters().viscosity.nu;
  double dt = t.max_step;
  if (max_speed > 0) dt = std::min(dt, t.cfl * d / max_speed);
  if (max_acceleration > 0) dt = std::min(dt, t.acceleration_factor * std::sqrt(d / max_acceleration));
  if (nu > 0) dt = std::min(dt, t.viscosity_factor * d * d / nu);
  const MicropolarParameters& m = world.parameters().micropolar;
  const bool rate = m.xsph_form == MicropolarParameters::xsph_form_t::rate;
  if (rate && m.gamma > 0) dt = std::min(dt, 0.5 * m.xsph_reference_step / m.gamma);  // smooths by a half at most
  return std::min(dt, micropolar_step_limit(world));
}

// `dt`, or less where a body is so fast on its way until then.
double step_beside_bodies(const World& world, double dt) {
  const double speed = body_speed(world.scene, world.time, world.time + dt);
  return speed > 0 ? std::min(dt, world.parameters().time.cfl * world.scene.spacing() / speed) : dt;
}

double largest_length(std::size_t n, const Array<Vec3>& field) {
  return std::sqrt(
      std::max(0.0, particle_max(n, [&](std::size_t i) { return double{dot(field[i], field[i])}; }).value));
}

// Largest speed as the fluid on the whole sees it, which is the same in every frame.
double largest_relative_speed(const World& world) {
  const Array<Vec3>& v = world.fields.velocity;
  const auto sum = ordered_sum<Vec3d>(world.count, [&](std::size_t begin, std::size_t end) {
    Vec3d part;
    for (std::size_t i = begin; i < end; ++i) part += to_double(v[i]);
    return part;
  });
  const Vec3d mean = 1 / static_cast<double>(world.count) * sum;
  const auto square = [&](std::size_t i) { return dot(to_double(v[i]) - mean, to_double(v[i]) - mean); };
  return std::sqrt(std::max(0.0, particle_max(world.count, square).value));
}

// (a . grad) of a field at a particle from its neighbours, uncorrected and without walls.
template <class Images>
Vec3 change_along(const World& world, const Array<Vec3>& field, std::size_t i, Vec3 a, const Images& images) {
  const Vec3 here = field[i];
  VectorSum change;
  for_pairs(world.neighbours, world.fields.position.data(), i, images, [&](const Pairs& p) {
    const Vec8 other = gather(field.data(), p.j);
    const f8 along = world.kernel.slope(p.r2) * (a.x * p.x + a.y * p.y + a.z * p.z);
    change.add(along * (other.x - here.x), along * (other.y - here.y), along * (other.z - here.z));
  });
  return world.mass / world.fields.density[i] * change.total();
}

// Particles that shifting (acceleration) and the density solve (displacement) move take on what the flow is at their
// new places, unless they are at a surface. Not the predicted vorticity: refinement would then give back more than
// there was (3D Taylor-Green vortex, 16^3 particles, t = 1: 0.1277 J/kg of 0.1250).
void carry_along(World& world, float full) {
  Fields& f = world.fields;
  const auto carry = [&](Array<Vec3>& field, auto&& change) {
    with_images(world.cells, [&](auto images) {
      parallel_for(world.count, [&](std::size_t i) {
        f.packed[i] = field[i];
        if (f.density[i] >= full) f.packed[i] += change(i, f.acceleration[i] + f.displacement[i], images);
      });
    });
    std::swap(field, f.packed);
  };
  if (!f.microrotation.empty()) {
    count_sweep(world);
    carry(f.microrotation, [&](std::size_t i, Vec3 move, const auto& images) {
      return change_along(world, f.microrotation, i, move, images);
    });
  }
  count_sweep(world);
  carry(f.velocity,
        [&](std::size_t i, Vec3 move, const auto& images) { return velocity_gradient(world, i, images).along(move); });
}

// -1/D sum V_j x_ij . grad W_ij, the mean over all particles: 1 on a lattice, some 0.98 where they lie in disorder, and
// by that share the sums for viscosity see too little of it. Known in filled domains only, by their gradient
// correction.
float second_moment(const World& world) {
  const Fields& f = world.fields;
  if (f.correction_diagonal.empty()) return 1;
  const int dimension = world.scene.dimension;
  const double corrections = particle_sum(world.count, [&](std::size_t i) {
    const Vec3 b = f.correction_diagonal[i];
    return double{b.x} + b.y + (dimension == 3 ? double{b.z} : 0.0);
  });
  return static_cast<float>(dimension * static_cast<double>(world.count) / corrections);
}

}  // namespace

void gravity(World& world) {
  const Vec3 g = gravity_of(world);
  parallel_for(world.count, [&](std::size_t i) { world.fields.acceleration[i] = g; });
  std::fill(world.fields.model_acceleration.begin(), world.fields.model_acceleration.end(), Vec3{});
}

void viscosity(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const ViscosityParameters& p = world.parameters().viscosity;
  const bool vector_form = p.form == ViscosityParameters::form_t::vector;
  const bool friction = !f.boundary_friction.empty();
  const float nu = static_cast<float>(p.nu), softening = world.kernel.softening();
  const float factor =
      2 * nu * world.mass * (vector_form ? static_cast<float>(world.scene.dimension + 2) : 1.0f) / second_moment(world);
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 v = f.velocity[i];
      f8 x{}, y{}, z{};
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p8) {
        const Vec8 other = gather(f.velocity.data(), p8.j);
        const f8 vx = v.x - other.x, vy = v.y - other.y, vz = v.z - other.z;
        // One density for both partners keeps the pair's forces opposite and equal.
        const f8 volume = 2.0f / (f.density[i] + gather(f.density.data(), p8.j));
        const f8 strength = volume * world.kernel.slope(p8.r2);
        if (vector_form) {
          const f8 along = strength * (vx * p8.x + vy * p8.y + vz * p8.z) / (p8.r2 + softening);
          x += along * p8.x;
          y += along * p8.y;
          z += along * p8.z;
        } else {
          x += strength * vx;
          y += strength * vy;
          z += strength * vz;
        }
      });
      f.acceleration[i] += factor * Vec3{sum(x), sum(y), sum(z)};
      if (friction) {
        const Vec3 pull = f.boundary_friction[i];
        f.acceleration[i] += nu * (pull - pull.w * v);
      }
    });
  });
}

double initial_time_step(const World& world) {
  const TimeParameters& t = world.parameters().time;
  if (t.fixed_step > 0) return t.fixed_step;
  const double speed = largest_length(world.count, world.fields.velocity);
  return step_beside_bodies(world, allowed_step(world, speed, length(world.scene.gravity)));
}

void choose_time_step(World& world) {
  world.report.max_speed = largest_length(world.count, world.fields.velocity);
  world.report.max_acceleration = largest_length(world.count, world.fields.acceleration);
  const TimeParameters& t = world.parameters().time;
  const double grown = t.growth * world.dt;
  if (t.fixed_step > 0) {
    world.dt = t.fixed_step;
    return;
  }
  const double allowed = allowed_step(world, world.report.max_speed, world.report.max_acceleration);
  world.dt = step_beside_bodies(world, std::min(grown, allowed));
}

void apply_forces(World& world) {
  const auto dt = static_cast<float>(world.dt);
  parallel_for(world.count, [&](std::size_t i) { world.fields.velocity[i] += dt * world.fields.acceleration[i]; });
}

void xsph(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const MicropolarParameters& p = world.parameters().micropolar;
  const bool rate = p.xsph_form == MicropolarParameters::xsph_form_t::rate;
  const double gamma = rate ? p.gamma * world.dt / p.xsph_reference_step : p.gamma;
  const float factor = 2 * static_cast<float>(gamma) * world.mass;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 v = f.velocity[i];
      f8 x{}, y{}, z{};
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p8) {
        const Vec8 other = gather(f.velocity.data(), p8.j);
        const f8 weight = world.kernel.value(p8.r2) / (f.density[i] + gather(f.density.data(), p8.j));
        x += weight * (other.x - v.x);
        y += weight * (other.y - v.y);
        z += weight * (other.z - v.z);
      });
      f.acceleration[i] = factor * Vec3{sum(x), sum(y), sum(z)};
    });
  });
  parallel_for(world.count, [&](std::size_t i) { f.velocity[i] += f.acceleration[i]; });
}

void shift_particles(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const double h = world.kernel.h();
  // Shifting is a diffusion of particles: beyond 0.2 h^2 a step it overshoots.
  const float strength = static_cast<float>(
      std::min(world.parameters().pressure.shifting * h * world.dt * largest_relative_speed(world), 0.2 * h * h));
  const float farthest = 0.2f * static_cast<float>(world.scene.spacing()), full = 0.9f * world.rest_density();
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      f8 x{}, y{}, z{};
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        const f8 slope = world.kernel.slope(p.r2);
        x += slope * p.x;
        y += slope * p.y;
        z += slope * p.z;
      });
      for_reflected_pairs(world, i, images, [&](const Pairs& p, f8 weight, const Reflection&) {
        const f8 slope = weight * world.kernel.slope(p.r2);
        x += slope * p.x;
        y += slope * p.y;
        z += slope * p.z;
      });
      Vec3 gradient = (world.mass / f.density[i]) * Vec3{sum(x), sum(y), sum(z)};
      if (world.bodies.count() > 0) {
        gradient += (1 / f.density[i]) * (f.boundary_gradient[i] - world.walls.sum(f.position[i]).gradient);
      }
      const Vec3 move = (f.density[i] >= full ? -strength : 0.0f) * gradient;
      const float distance = length(move);
      f.acceleration[i] = distance > farthest ? (farthest / distance) * move : move;
    });
  });
  carry_along(world, full);
  parallel_for(world.count, [&](std::size_t i) { f.position[i] += f.acceleration[i]; });
}

void advect(World& world) {
  Fields& f = world.fields;
  const auto dt = static_cast<float>(world.dt);
  const Domain& domain = world.scene.domain;
  const CellShape& cells = world.cells;
  const bool corrected = world.parameters().pressure.two_sided;
  const double held = particle_sum(world.count, [&](std::size_t i) {
    Vec3& x = f.position[i];
    const Vec3 before = x;
    x += dt * f.velocity[i];
    if (corrected) x += f.displacement[i];
    for (int axis = 0; axis < 3; ++axis) {
      if (cells.periodic_cells[axis] == 0) continue;
      const float low = static_cast<float>(domain.min[axis]), period = cells.period[axis];
      x[axis] -= period * std::floor((x[axis] - low) / period);
    }
    const bool at_wall = world.walls.hold(x, f.velocity[i]);
    const bool at_body = world.obstacles->hold(x, f.velocity[i], before, world.body_places);
    if (at_body && world.walls.hold(x, f.velocity[i]) && world.obstacles->contains(x, world.body_places)) x = before;
    return at_body || at_wall ? 1.0 : 0.0;
  });
  world.report.wall_contacts = static_cast<std::int64_t>(held);
}

void remove_escaped(World& world) {
  Fields& f = world.fields;
  const Domain& domain = world.scene.domain;
  const double reach = world.kernel.support();
  std::vector<std::uint32_t> stay;
  for (std::uint32_t i = 0; i < world.count; ++i) {
    bool inside = true;
    for (int axis = 0; axis < world.scene.dimension; ++axis) {
      const double x = double{f.position[i][axis]};
      inside = inside && x > domain.min[axis] - reach && x < domain.max[axis] + reach;
    }
    if (inside) stay.push_back(i);
  }
  if (stay.size() == world.count) return;
  world.count = stay.size();
  for_each_field(f, [&](const FieldRow& row, auto& array) {
    if (array.empty()) return;
    for (std::size_t k = 0; k < stay.size() && is_state(row.kind); ++k) array[k] = array[stay[k]];
    array.resize(stay.size());
  });
}

void compute_vorticity(World& world) {
  count_sweep(world);
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) { world.fields.vorticity[i] = velocity_curl(world, i, images); });
  });
}

}  // namespace curlew
