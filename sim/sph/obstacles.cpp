#include "sim/sph/obstacles.h"

#include <algorithm>
#include <cmath>

namespace curlew {
namespace {

// A body that stands on the floor goes on below it here: a face in the plane of a wall is no way out for a particle
// that is held at that plane, and none that leads anywhere. Meshes stay as they are, and so do bodies that move off
// that wall.
struct Extension {
  const Domain& domain;
  int dimension;
  double by, slack;  // m

  // How far to go on below (or above) along an axis where the shape ends at `low` (or `high`).
  double below(double low, int axis) const {
    return axis < dimension && std::abs(low - domain.min[axis]) < slack ? by : 0;
  }
  double above(double high, int axis) const {
    return axis < dimension && std::abs(high - domain.max[axis]) < slack ? by : 0;
  }

  void operator()(Box& box) const {
    for (int axis = 0; axis < dimension; ++axis) {
      box.min[axis] -= below(box.min[axis], axis);
      box.max[axis] += above(box.max[axis], axis);
    }
  }

  void operator()(Cylinder& cylinder) const {
    if (dimension == 2) return;
    const Vec3d way = (1 / length(cylinder.to - cylinder.from)) * (cylinder.to - cylinder.from);
    const auto beyond = [&](Vec3d end) {
      double most = 0;
      for (int axis = 0; axis < dimension; ++axis) {
        if (std::abs(way[axis]) < 0.7) continue;  // the end's face does not lie in that wall
        most = std::max({most, below(end[axis], axis), above(end[axis], axis)});
      }
      return most;
    };
    const double first = beyond(cylinder.from), last = beyond(cylinder.to);
    cylinder.from = cylinder.from - first * way;
    cylinder.to = cylinder.to + last * way;
  }

  // Repeats the outermost heights beyond the sides.
  void operator()(Heightfield& field) const {
    field.min.y -= below(field.min.y, 1);
    const auto widen = [&](double& min, double& max, int axis, int lines, auto&& repeat) {
      if (lines < 2) return;
      const double step = (max - min) / (lines - 1);
      const auto number = [&](double wanted) { return static_cast<int>(std::ceil(wanted / step)); };
      const int before = number(below(min, axis)), after = number(above(max, axis));
      repeat(before, after);
      min -= before * step;
      max += after * step;
    };
    widen(field.min.x, field.max.x, 0, field.columns, [&](int before, int after) {
      std::vector<double> heights;
      for (int row = 0; row < field.rows; ++row) {
        const auto at = field.heights.begin() + static_cast<std::ptrdiff_t>(row) * field.columns;
        heights.insert(heights.end(), static_cast<std::size_t>(before), *at);
        heights.insert(heights.end(), at, at + field.columns);
        heights.insert(heights.end(), static_cast<std::size_t>(after), *(at + field.columns - 1));
      }
      field.heights = std::move(heights);
      field.columns += before + after;
    });
    if (dimension == 2) return;
    widen(field.min.z, field.max.z, 2, field.rows, [&](int before, int after) {
      const auto columns = static_cast<std::ptrdiff_t>(field.columns);
      const std::vector<double> first(field.heights.begin(), field.heights.begin() + columns),
          last(field.heights.end() - columns, field.heights.end());
      for (int k = 0; k < before; ++k) field.heights.insert(field.heights.begin(), first.begin(), first.end());
      for (int k = 0; k < after; ++k) field.heights.insert(field.heights.end(), last.begin(), last.end());
      field.rows += before + after;
    });
  }

  template <class Other>
  void operator()(Other&) const {}
};

}  // namespace

Obstacles::Obstacles(const Scene& scene) : dimension_(scene.dimension), spacing_(scene.spacing()) {
  std::vector<Domain> domains;
  for (const Body& body : scene.bodies) {
    shapes_.push_back(body.shape);
    domains.push_back(domain_around(body, scene.domain));
    std::visit(Extension{domains.back(), dimension_, 4 * spacing_, 1e-3 * spacing_}, shapes_.back());
  }
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    obstacles_.push_back({bounds(shapes_[k], dimension_, domains[k]), ShapeProbe(shapes_[k], dimension_)});
  }
}

Obstacles::Found Obstacles::around(Vec3 x, std::span<const BodyPlace> places) const {
  for (std::size_t k = 0; k < obstacles_.size(); ++k) {
    const Obstacle& obstacle = obstacles_[k];
    const BodyPlace place = places.empty() ? BodyPlace{} : places[k];
    const Vec3d p = to_double(x) - place.offset;
    const Box& box = obstacle.bounds;
    bool near = true;
    for (int axis = 0; axis < dimension_; ++axis) near = near && p[axis] >= box.min[axis] && p[axis] <= box.max[axis];
    if (near && obstacle.probe.inside(p)) return {&obstacle, place};
  }
  return {};
}

bool Obstacles::contains(Vec3 x, std::span<const BodyPlace> places) const { return around(x, places).body != nullptr; }

bool Obstacles::hold(Vec3& x, Vec3& v, Vec3 before, std::span<const BodyPlace> places) const {
  Found found = around(x, places);
  if (found.body == nullptr) return false;
  const double reach = 8 * spacing_, step = 0.01 * spacing_, clear = 1e-4 * spacing_;
  Vec3d p = to_double(x);
  for (int attempt = 0; attempt < 4 && found.body != nullptr; ++attempt) {
    const auto distance = [&](Vec3d q) { return found.body->probe.distance(q - found.place.offset, reach); };
    Vec3d normal;
    for (int axis = 0; axis < dimension_; ++axis) {
      Vec3d aside;
      aside[axis] = step;
      normal[axis] = distance(p + aside) - distance(p - aside);
    }
    if (length(normal) == 0) break;
    normal = (1 / length(normal)) * normal;
    p = p + (clear - distance(p)) * normal;
    const Vec3 n = to_float(normal);
    const float into = dot(v - to_float(found.place.velocity), n);
    if (into < 0) v = v - into * n;
    found = around(to_float(p), places);
  }
  x = found.body == nullptr ? to_float(p) : before;
  return true;
}

}  // namespace curlew
