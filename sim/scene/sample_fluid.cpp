// Fluid as particles on lattices.
#include <algorithm>
#include <cmath>

#include "sim/core/error.h"
#include "sim/scene/json.h"
#include "sim/scene/point_grid.h"
#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"
#include "sim/scene/shapes.h"

namespace curlew {
namespace {

constexpr double tolerance = 1e-6;      // of a spacing: what lies on a border lies on its near side
constexpr double least_distance = 0.7;  // of a spacing, between particles of two fluids

// Where a lattice runs along one axis.
struct LatticeAxis {
  double first = 0;
  std::int64_t count = 1;
};

// A lattice of its own: n spacings to an edge of n d, whatever the last digits of the edge and d.
LatticeAxis own_lattice(double min, double max, double d) {
  const double count = std::ceil((max - min) / d - 0.5 - tolerance);
  return {min + d / 2, static_cast<std::int64_t>(std::max(count, 0.0))};
}

// The part of the domain's lattice between min and max.
LatticeAxis domain_lattice(double min, double max, double d, double domain_min) {
  const double origin = domain_min + d / 2;
  const double begin = std::ceil((min - origin) / d - tolerance), end = std::floor((max - origin) / d + tolerance);
  return {origin + begin * d, static_cast<std::int64_t>(std::max(end - begin + 1, 0.0))};
}

std::array<LatticeAxis, 3> lattice_of(const Shape& shape, const Scene& scene) {
  const Box box = bounds(shape, scene.dimension, scene.domain);
  const bool own = std::holds_alternative<Box>(shape) || std::holds_alternative<Heightfield>(shape);
  std::array<LatticeAxis, 3> axes;
  for (int k = 0; k < scene.dimension; ++k) {
    axes[static_cast<std::size_t>(k)] =
        own ? own_lattice(box.min[k], box.max[k], scene.spacing())
            : domain_lattice(box.min[k], box.max[k], scene.spacing(), scene.domain.min[k]);
  }
  return axes;
}

// Which points of the lattices may hold particles.
class FreeSpace {
 public:
  explicit FreeSpace(const Scene& scene) : scene_(scene) {
    for (const Body& body : scene.bodies) {
      bodies_.push_back({ShapeProbe(body.shape, scene.dimension), body.motion.at(0).offset});
    }
  }

  bool holds(Vec3d p) const {
    const double r = scene_.particle_radius;
    for (int axis = 0; axis < scene_.dimension; ++axis) {
      const bool periodic = scene_.domain.periodic[static_cast<std::size_t>(axis)];
      const double margin = periodic ? 0 : r, slack = 2 * r * tolerance;
      if (p[axis] < scene_.domain.min[axis] + margin - slack) return false;
      if (p[axis] > scene_.domain.max[axis] - margin + (periodic ? -slack : slack)) return false;
    }
    for (const PlacedBody& body : bodies_) {
      if (body.probe.distance(p - body.offset, 2 * r) < r * (1 - tolerance)) return false;
    }
    return true;
  }

 private:
  struct PlacedBody {
    ShapeProbe probe;
    Vec3d offset;  // at the start
  };
  const Scene& scene_;
  std::vector<PlacedBody> bodies_;
};

// Calls visit(point) for every lattice point of the fluid that free space holds; a visitor that answers false says that
// it did not take the point. Returns how many it took.
template <class Visit>
std::int64_t for_each_point(const Fluid& fluid, const Scene& scene, const FreeSpace& space, Visit&& visit) {
  const auto [xs, ys, zs] = lattice_of(fluid.shape, scene);
  const double d = scene.spacing();
  const bool whole = std::holds_alternative<Box>(fluid.shape);
  const ShapeProbe probe(fluid.shape, scene.dimension);
  std::int64_t taken = 0;
  for (std::int64_t i = 0; i < xs.count; ++i) {
    for (std::int64_t j = 0; j < ys.count; ++j) {
      for (std::int64_t k = 0; k < zs.count; ++k) {
        const Vec3d p{xs.first + static_cast<double>(i) * d, ys.first + static_cast<double>(j) * d,
                      zs.first + static_cast<double>(k) * d};
        if ((whole || probe.inside(p)) && space.holds(p)) taken += visit(p) ? 1 : 0;
      }
    }
  }
  return taken;
}

bool any_periodic(const Scene& scene) {
  return std::any_of(scene.domain.periodic.begin(), scene.domain.periodic.end(),
                     [](bool periodic) { return periodic; });
}

}  // namespace

// p moved by a random amount that depends on the particle's number alone (SplitMix64, Steele et al. 2014), not past a
// wall and around a periodic axis.
Vec3d jittered(Vec3d p, double jitter, std::size_t number, const Scene& scene) {
  std::uint64_t state = 0x9e3779b97f4a7c15u * (number + 1);
  for (int axis = 0; axis < scene.dimension; ++axis) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    const double random = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
    p[axis] += jitter * scene.spacing() * random;
    const double low = scene.domain.min[axis], length = scene.domain.max[axis] - low;
    if (scene.domain.periodic[axis]) p[axis] -= length * std::floor((p[axis] - low) / length);
  }
  return p;
}

ParticleSample sample_fluid(const Scene& scene) {
  check_resolution(scene);
  const FreeSpace space(scene);
  const double reach = least_distance * scene.spacing();
  // A lattice keeps its own points apart; only a second fluid, or a wrap, can bring others near.
  const bool crowded = scene.fluid.size() > 1 || any_periodic(scene);
  PointGrid taken(reach, scene.domain);
  ParticleSample sample;
  for (std::size_t f = 0; f < scene.fluid.size(); ++f) {
    const Fluid& fluid = scene.fluid[f];
    const auto take = [&](Vec3d p) {
      if (crowded && taken.any_within(p, reach)) return false;
      if (crowded) taken.add(p);
      if (fluid.jitter > 0) p = jittered(p, fluid.jitter, sample.position.size(), scene);
      sample.position.push_back(p);
      sample.velocity.push_back(initial_velocity(fluid.velocity, p, scene));
      return true;
    };
    if (for_each_point(fluid, scene, space, take) == 0) {
      throw InputError(scene.file.string() + ": fluid[" + std::to_string(f) + "] (" +
                       std::string(shape_name(fluid.shape)) +
                       ") holds no particle, expected one at least: it may lie " +
                       "outside the domain, in a body or another fluid, or be smaller than the spacing of " +
                       plain_number(scene.spacing()) + " m");
    }
  }
  return sample;
}

std::int64_t count_particles(const Scene& scene) {
  if (scene.fluid.size() > 1 || any_periodic(scene))
    return static_cast<std::int64_t>(sample_fluid(scene).position.size());
  check_resolution(scene);
  const FreeSpace space(scene);
  return for_each_point(scene.fluid.at(0), scene, space, [](Vec3d) { return true; });
}

}  // namespace curlew
