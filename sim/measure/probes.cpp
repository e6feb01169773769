#include "sim/measure/probes.h"

#include <algorithm>
#include <cmath>

#include "sim/sph/candidates.h"

namespace curlew {
namespace {

using Quantity = Probe::Quantity;

// sum W A over sum W, for A given by f(particle); nothing where no particle is within the support.
template <class F>
std::optional<Vec3d> mean_at(const World& world, Vec3d point, F&& f) {
  Candidates near;
  Grid::Hints hints;
  near.collect(world.cells, world.grid, world.cells.cell_of(to_float(point)), world.fields.position, hints);
  Vec3d sum;
  double weights = 0;
  for (std::size_t k = 0; k < near.size; ++k) {
    const double weight = world.kernel.value(length(point - Vec3d{near.x[k], near.y[k], near.z[k]}));
    weights += weight;
    sum += weight * f(near.number[k]);
  }
  if (!(weights > 0)) return {};
  return (1 / weights) * sum;
}

// Density that fluid has at a point, kg/m^3, where the walls are mirrors, so that a height at a wall is that of the
// water and not of the half of a kernel that is left.
double mirrored_density(const World& world, Vec3d point, const Candidates& near) {
  Reflection images[Walls::most_reflections];
  const int number = world.walls.reflections(to_float(point), images);
  double sum = 0;
  for (std::size_t k = 0; k < near.size; ++k) {
    const Vec3d x = point - Vec3d{near.x[k], near.y[k], near.z[k]};
    sum += world.kernel.value(length(x));
    for (int image = 0; image < number; ++image) {
      const Reflection& r = images[image];
      const Vec3d mirrored{r.sign.x * x.x + r.offset.x, r.sign.y * x.y + r.offset.y, r.sign.z * x.z + r.offset.z};
      sum += world.kernel.value(length(mirrored));
    }
  }
  return world.mass * sum;
}

// Looks down a column for the highest water.
class Column {
 public:
  explicit Column(const World& world) : world_(world) {}

  // Positive in water, negative in air: by how much the density exceeds half of that of rest, where a body leaves room
  // for less of it.
  double surface_signal(Vec3d point) {
    const Vec3 here = to_float(point);
    const auto cell = world_.cells.cell_of(here);
    if (!collected_ || cell != cell_) {
      Grid::Hints hints, body_hints;
      fluid_.collect(world_.cells, world_.grid, cell, world_.fields.position, hints);
      world_.bodies.collect(world_.cells, cell, body_, body_hints);
      cell_ = cell;
      collected_ = true;
    }
    const double rest = double{world_.rest_density()};
    if (fluid_.size == 0 || world_.obstacles->contains(here, world_.body_places)) return -rest / 2;
    WallSum bodies;
    if (body_.size > 0) world_.bodies.add(bodies, here, body_, world_.kernel, world_.rest_density());
    return mirrored_density(world_, point, fluid_) - (rest - double{bodies.gradient.w}) / 2;
  }

 private:
  const World& world_;
  Candidates fluid_, body_;
  std::array<int, 3> cell_{};
  bool collected_ = false;
};

// The highest place on the vertical through `place` at which the density falls through half of rest: on a lattice that
// is half a spacing over the highest layer. Looked for in steps of a quarter spacing, linear in between.
std::optional<double> water_height(const World& world, Vec3d place) {
  const Scene& scene = world.scene;
  const int axis = scene.vertical_axis();
  const bool upwards = scene.gravity[axis] <= 0;
  const double bottom = upwards ? scene.domain.min[axis] : scene.domain.max[axis];
  const double extent = scene.domain.max[axis] - scene.domain.min[axis];
  const int steps = std::max(1, static_cast<int>(std::ceil(extent / (scene.spacing() / 4))));
  Column column(world);
  double above = 0, height_above = extent;
  for (int k = steps; k >= 0; --k) {
    const double height = extent * k / steps;
    place[axis] = upwards ? bottom + height : bottom - height;
    const double signal = column.surface_signal(place);
    if (signal > 0) return k == steps ? height : std::lerp(height, height_above, signal / (signal - above));
    above = signal;
    height_above = height;
  }
  return {};
}

void add_values(const World& world, Quantity quantity, Vec3d point, std::vector<std::optional<double>>& values) {
  const Fields& fields = world.fields;
  switch (quantity) {
    case Quantity::pressure: {
      const auto pressure = mean_at(world, point, [&](std::size_t j) { return Vec3d{fields.pressure[j], 0, 0}; });
      values.push_back(pressure && world.step > 0 ? std::optional(pressure->x) : std::nullopt);
      break;
    }
    case Quantity::velocity: {
      const auto velocity = mean_at(world, point, [&](std::size_t j) { return to_double(fields.velocity[j]); });
      for (int axis = 0; axis < world.scene.dimension; ++axis) {
        values.push_back(velocity ? std::optional((*velocity)[axis]) : std::nullopt);
      }
      break;
    }
    case Quantity::water_height:
      values.push_back(water_height(world, point));
      break;
  }
}

}  // namespace

FieldSet probe_fields(const Scene& scene) {
  for (const Probe& probe : scene.probes) {
    if (probe.quantity == Quantity::pressure) return {FieldId::pressure};
  }
  return {};
}

std::vector<std::string> probe_columns(const Probe& probe, int dimension) {
  std::vector<std::string> columns;
  for (int point = 0; point < probe.points; ++point) {
    const std::string name = probe.points > 1 ? probe.name + "[" + std::to_string(point) + "]" : probe.name;
    if (probe.quantity != Quantity::velocity) {
      columns.push_back(name);
      continue;
    }
    for (int axis = 0; axis < dimension; ++axis) columns.push_back(name + "." + "xyz"[axis]);
  }
  return columns;
}

std::vector<std::optional<double>> measure(const World& world, const Probe& probe) {
  std::vector<std::optional<double>> values;
  for (int point = 0; point < probe.points; ++point) add_values(world, probe.quantity, probe.at(point), values);
  return values;
}

}  // namespace curlew
