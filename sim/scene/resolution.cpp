#include "sim/scene/resolution.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "sim/core/error.h"
#include "sim/scene/json.h"
#include "sim/scene/sampling.h"
#include "sim/scene/shapes.h"

namespace curlew {
namespace {

constexpr double most_particles = 2147483648.0;  // ids are 32 bits wide
constexpr double bytes_a_particle = 700, bytes_a_sample = 1000;

// Two digits, for estimates in messages.
std::string about(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.1e", value);
  return plain_number(std::strtod(buffer, nullptr));
}

double fluid_volume(const Scene& scene) {
  double sum = 0;
  for (const Fluid& fluid : scene.fluid) sum += volume(fluid.shape, scene.dimension, scene.domain);
  return sum;
}

void check_size(const Scene& scene, double memory) {
  const double particles = estimate_particles(scene), need = estimate_memory(scene);
  const auto fail = [&](const std::string& what) {
    throw InputError(scene.file.string() + ": particle_radius " + plain_number(scene.particle_radius) +
                     " m makes about " + about(particles) + " particles, " + what +
                     ", expected a larger particle_radius");
  };
  if (need > memory) {
    fail("which with their boundary need about " + bytes_text(need) + " of memory where this machine has " +
         bytes_text(memory));
  }
  if (particles > most_particles) fail("more than the " + plain_number(most_particles) + " that can be numbered");
}

// A float has 24 bits: from 50,000 spacings on, a step of a thousandth of a spacing is lost.
void check_precision(const Scene& scene) {
  constexpr double farthest = 50000;
  for (int axis = 0; axis < scene.dimension; ++axis) {
    const double reach = std::max(std::abs(scene.domain.min[axis]), std::abs(scene.domain.max[axis]));
    if (reach <= farthest * scene.spacing()) continue;
    throw InputError(scene.file.string() + ": domain reaches " + plain_number(reach) + " m from the origin, which is " +
                     about(reach / scene.spacing()) + " particle spacings of " + plain_number(scene.spacing()) +
                     " m, expected at most " + plain_number(farthest) + " (single precision resolves no more)");
  }
}

void check_periodic(const Scene& scene, int axis) {
  const double width = scene.domain.max[axis] - scene.domain.min[axis], d = scene.spacing();
  const double least = 4 * 2 * scene.parameters.sph.h_over_d * d;
  const std::string place =
      scene.file.string() + ": the periodic axis " + "xyz"[axis] + " is " + plain_number(width) + " m wide";
  if (width < least * (1 - 1e-9)) {
    throw InputError(place + ", expected at least 4 kernel supports, which are " + plain_number(least) + " m");
  }
  const double count = std::round(width / d);
  if (std::abs(count * d - width) > 1e-6 * width) {
    throw InputError(place + ", which is " + plain_number(width / d) + " particle spacings, expected a whole number: " +
                     "particle_radius " + plain_number(width / count / 2) + " would fit");
  }
}

// The edge that the spacing is to divide: the shortest periodic width, else the shortest edge of the first box of
// fluid.
std::optional<double> edge_to_divide(const Scene& scene) {
  std::optional<double> edge;
  const auto take = [&](const Box& box, bool only_periodic) {
    for (int axis = 0; axis < scene.dimension; ++axis) {
      if (only_periodic && !scene.domain.periodic[static_cast<std::size_t>(axis)]) continue;
      const double width = box.max[axis] - box.min[axis];
      if (width > 0) edge = std::min(edge.value_or(width), width);
    }
  };
  take({scene.domain.min, scene.domain.max}, true);
  for (const Fluid& fluid : scene.fluid) {
    if (edge) break;
    if (std::holds_alternative<Box>(fluid.shape)) take(bounds(fluid.shape, scene.dimension, scene.domain), false);
  }
  return edge;
}

bool divides_periodic_widths(const Scene& scene) {
  for (int axis = 0; axis < scene.dimension; ++axis) {
    if (!scene.domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const double width = scene.domain.max[axis] - scene.domain.min[axis];
    const double count = width / scene.spacing();
    if (std::abs(count - std::round(count)) > 1e-6 * count) return false;
  }
  return true;
}

// Spacings near d at which the edge divides evenly; without an edge, a fan of spacings up to 3 % away.
std::vector<double> candidate_spacings(std::optional<double> edge, double d) {
  std::vector<double> spacings;
  for (int k = -3; k <= 3; ++k) {
    const double parts = edge ? std::round(*edge / d) + k : 0;
    if (!edge) spacings.push_back(d * (1 + 0.01 * k));
    if (parts >= 1) spacings.push_back(*edge / parts);
  }
  return spacings;
}

}  // namespace

double estimate_particles(const Scene& scene) {
  return fluid_volume(scene) / std::pow(scene.spacing(), scene.dimension);
}

double estimate_memory(const Scene& scene) {
  double area = 0;
  for (const Body& body : scene.bodies) {
    area += surface_area(body.shape, scene.dimension, domain_around(body, scene.domain));
  }
  return bytes_a_particle * estimate_particles(scene) +
         bytes_a_sample * area / std::pow(scene.spacing(), scene.dimension - 1);
}

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void check_resolution(const Scene& scene) { check_resolution(scene, machine_memory()); }

void check_resolution(const Scene& scene, double memory_of_machine) {
  check_size(scene, memory_of_machine);
  check_precision(scene);
  for (int axis = 0; axis < scene.dimension; ++axis) {
    if (scene.domain.periodic[static_cast<std::size_t>(axis)]) check_periodic(scene, axis);
  }
}

Scene with_particles(Scene scene, double n) {
  if (!(n >= 1 && n <= most_particles)) {
    throw InputError("--particles is " + plain_number(n) + ", expected a number from 1 to " +
                     plain_number(most_particles));
  }
  const double d = std::pow(fluid_volume(scene) / n, 1.0 / scene.dimension);
  if (!(d > 0))
    throw InputError(scene.file.string() + ": the fluid has no volume, expected some to fill with particles");
  double best_miss = 0, best_radius = 0;
  std::string refusal;
  for (const double spacing : candidate_spacings(edge_to_divide(scene), d)) {
    scene.particle_radius = spacing / 2;
    if (!divides_periodic_widths(scene)) continue;
    try {
      const double miss = std::abs(static_cast<double>(count_particles(scene)) - n);
      if (best_radius == 0 || miss < best_miss) {
        best_miss = miss;
        best_radius = scene.particle_radius;
      }
    } catch (const InputError& error) {
      if (refusal.empty()) refusal = error.what();
    }
  }
  if (best_radius == 0) {
    throw InputError(refusal.empty()
                         ? scene.file.string() + ": no spacing near " + about(n) +
                               " particles divides all periodic widths, expected widths in small whole ratios"
                         : refusal);
  }
  scene.particle_radius = best_radius;
  return scene;
}

std::string bytes_text(double bytes) {
  constexpr const char* units[] = {"B", "kB", "MB", "GB", "TB", "PB", "EB", "ZB", "YB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, bytes < 9.95 && unit > 0 ? "%.1f %s" : "%.0f %s", bytes, units[unit]);
  return buffer;
}

}  // namespace curlew
