#include "sim/measure/probes.h"

#include <algorithm>
#include <cmath>

#include "sim/sph/candidates.h"

namespace curlew {
namespace {

using Quantity = Probe::Quantity;

// How far the plane is followed out of the cloud of particles, in the cloud's own standard deviations. On a lattice
// with h = d a flat wall is 3.4 away, an edge 4.8, a corner 5.9; a point over a surface may be any number away.
constexpr double farthest_deviation = 6.5;

struct Share {
  std::uint32_t particle;
  double weight;
};

// y with M y = v, M given by its columns.
Vec3d solved(const Vec3d (&m)[3], double determinant, Vec3d v) {
  return (1 / determinant) * Vec3d{dot(v, cross(m[1], m[2])), dot(m[0], cross(v, m[2])), dot(m[0], cross(m[1], v))};
}

// What each particle near `point` adds to the fitted value there. With w_j = W(x_0 - x_j) / sum W, r_j = x_j - x_0, the
// mean c of r_j and their covariance C,
//   A(x_0) = sum_j w_j (1 - s c . C^-1 (r_j - c)) A_j,
// where s = 1, or less where sqrt(c . C^-1 c) is more than farthest_deviation; s = 0 is Shepard's mean.
std::vector<Share> shares_at(const World& world, Vec3d point) {
  Candidates near;
  Grid::Hints hints;
  near.collect(world.cells, world.grid, world.cells.cell_of(to_float(point)), world.fields.position, hints);
  std::vector<Share> shares;
  std::vector<Vec3d> offset;
  double total = 0;
  Vec3d centre;
  for (std::size_t k = 0; k < near.size; ++k) {
    const Vec3d r = Vec3d{near.x[k], near.y[k], near.z[k]} - point;
    const double weight = world.kernel.value(length(r));
    if (!(weight > 0)) continue;
    shares.push_back({near.number[k], weight});
    offset.push_back(r);
    total += weight;
    centre += weight * r;
  }
  if (shares.empty()) return shares;
  centre = (1 / total) * centre;
  for (Share& share : shares) share.weight /= total;

  Vec3d covariance[3];
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const Vec3d r = offset[k] - centre;
    for (int axis = 0; axis < 3; ++axis) covariance[axis] += (shares[k].weight * r[axis]) * r;
  }
  const double h2 = world.kernel.h() * world.kernel.h();
  if (world.scene.dimension == 2) covariance[2] = {0, 0, h2};
  const double determinant = dot(covariance[0], cross(covariance[1], covariance[2]));
  if (!(determinant > 1e-9 * h2 * h2 * h2)) return shares;  // all in one plane, or fewer than span the space
  const Vec3d slope = solved(covariance, determinant, centre);
  const double deviation = std::sqrt(std::max(0.0, dot(slope, centre)));
  const double s = deviation > farthest_deviation ? farthest_deviation / deviation : 1;
  for (std::size_t k = 0; k < shares.size(); ++k) shares[k].weight *= 1 - s * dot(slope, offset[k] - centre);
  return shares;
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
    if (fluid_.size == 0 || world_.obstacles->contains(here)) return -rest / 2;
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
  if (quantity == Quantity::water_height) return values.push_back(water_height(world, point));
  const std::vector<Share> shares = shares_at(world, point);
  if (quantity == Quantity::pressure) {
    double pressure = 0;
    for (const Share& s : shares) pressure += s.weight * double{world.fields.pressure[s.particle]};
    return values.push_back(shares.empty() || world.step == 0 ? std::nullopt : std::optional(pressure));
  }
  Vec3d velocity;
  for (const Share& s : shares) velocity += s.weight * to_double(world.fields.velocity[s.particle]);
  for (int axis = 0; axis < world.scene.dimension; ++axis) {
    values.push_back(shares.empty() ? std::nullopt : std::optional(velocity[axis]));
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
