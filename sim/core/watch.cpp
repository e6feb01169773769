#include "sim/core/watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/measure/diagnostics.h"
#include "sim/sph/moving_bodies.h"
#include "sim/turbulence/micropolar_bender2018.h"

namespace curlew {
namespace {

bool has_torque(const World& world) {
  const MicropolarParameters& m = world.parameters().micropolar;
  return m.torque_x != 0 || m.torque_y != 0 || m.torque_z != 0;
}

// Gravity along a periodic axis is a pressure gradient: it drives the fluid for ever.
bool falls_for_ever(const Scene& scene) {
  for (int axis = 0; axis < scene.dimension; ++axis) {
    if (scene.domain.periodic[axis] && scene.gravity[axis] != 0) return true;
  }
  return false;
}

double wall_speed(const Scene& scene) {
  double fastest = 0;
  for (const Wall& wall : scene.domain.walls) fastest = std::max(fastest, length(wall.velocity));
  return fastest;
}

bool has_free_model(const World& world) {
  const Parameters& p = world.parameters();
  return !p.energy.guard && (p.vorticity_confinement.epsilon > 0 || p.vorticity_refinement.alpha > 0 ||
                             p.wavelet.amplitude > 0 || transfer_coefficient(p) != 0);
}

bool is_driven(const World& world) {
  return has_torque(world) || has_free_model(world) || falls_for_ever(world.scene) || wall_speed(world.scene) > 0 ||
         bodies_move(world.scene, world.time - world.dt, world.time);  // in the step that the energy is of
}

Largest fastest(const World& world) {
  const Array<Vec3>& v = world.fields.velocity;
  Largest found = particle_max(world.count, [&](std::size_t i) { return double{dot(v[i], v[i])}; });
  found.value = world.count > 0 ? std::sqrt(found.value) : 0;
  return found;
}

// The speed that the scene can bring forth, m/s; 0 where nothing bounds it.
double natural_speed(const World& world) {
  if (has_torque(world) || falls_for_ever(world.scene)) return 0;
  double fall = 0;  // half the square of the speed after a fall through the domain
  for (int axis = 0; axis < world.scene.dimension; ++axis) {
    fall += std::abs(world.scene.gravity[axis]) * (world.scene.domain.max[axis] - world.scene.domain.min[axis]);
  }
  return world.start.speed + wall_speed(world.scene) + body_speed(world.scene) + std::sqrt(2 * fall);
}

std::string text(const char* format, double a, double b = 0, double c = 0) {
  char line[300];
  std::snprintf(line, sizeof line, format, a, b, c);
  return line;
}

const char* advice(const World& world) {
  const Parameters& p = world.parameters();
  const double d = world.scene.spacing();
  if (p.time.fixed_step > 0) return "use a smaller time.fixed_step";
  if (has_free_model(world)) return "switch energy.guard on, or make the turbulence models weaker";
  if (p.viscosity.nu * world.dt > 0.25 * d * d) return "lower time.viscosity_factor";
  return "lower time.cfl or raise pressure.max_iterations";
}

[[noreturn]] void report(const World& world, std::string_view pass, std::size_t particle, const std::string& what) {
  const std::uint32_t id = world.fields.id[particle];
  throw DivergedError("the simulation diverged at step " + std::to_string(world.step + 1) + ", time " +
                          number_text(world.time) + " s: after pass " + std::string(pass) + " particle " +
                          std::to_string(id) + " " + what + "; " + advice(world),
                      std::string(pass), id);
}

}  // namespace

void remember_start(World& world) {
  if (!world.start.known) forgive(world);
}

void forgive(World& world) { world.start = {fastest(world).value, diagnose(world).total(), true}; }

void check_velocities(const World& world, std::string_view pass) {
  if (world.count == 0) return;
  const Largest found = fastest(world);
  if (!std::isfinite(found.value)) report(world, pass, found.index, "has a velocity that is not finite");
  const TimeParameters& t = world.parameters().time;
  const double farthest = t.max_displacement * world.scene.spacing() / world.dt;
  if (found.value > farthest) {
    report(world, pass, found.index,
           text("reached %.3g m/s, more than the %.3g m/s that time.max_displacement allows in a step of %.3g s",
                found.value, farthest, world.dt));
  }
  const double natural = natural_speed(world);
  if (natural > 0 && found.value > t.max_speed * natural) {
    report(world, pass, found.index,
           text("reached %.3g m/s, more than time.max_speed (%.3g) times the %.3g m/s that the scene can bring forth",
                found.value, t.max_speed, natural));
  }
}

void watch_energy(World& world) {
  const double energy = diagnose(world).total();
  if (is_driven(world)) {
    world.start.energy = std::max(world.start.energy, energy);
    return;
  }
  const double most = world.parameters().time.max_energy * world.start.energy;
  if (world.start.energy <= 0 || !(energy > most)) return;  // what is no number, check_velocities() names
  const Largest found = fastest(world);
  report(world, "energy_watch", found.index,
         text("is the fastest, at %.3g m/s, and the water has %.3g J, more than time.max_energy (%.3g) ", found.value,
              energy, world.parameters().time.max_energy) +
             text("times the %.3g J of the start although nothing drives it", world.start.energy));
}

}  // namespace curlew
