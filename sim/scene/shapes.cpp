#include "sim/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/scene/heightfield.h"
#include "sim/scene/mesh.h"

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;

template <class... Functions>
struct Overload : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overload(Functions...) -> Overload<Functions...>;

Vec3d flat(Vec3d p, int dimension) { return dimension == 2 ? Vec3d{p.x, p.y, 0} : p; }

// Distance to a box-like set whose faces p exceeds by `beyond`, negative where p lies within.
double box_distance(std::initializer_list<double> beyond) {
  double square = 0, largest = -std::numeric_limits<double>::infinity();
  for (const double b : beyond) {
    largest = std::max(largest, b);
    square += b > 0 ? b * b : 0;
  }
  return largest > 0 ? std::sqrt(square) : largest;
}

double distance_to(const Box& box, Vec3d p, int dimension) {
  const auto beyond = [&](int axis) { return std::max(box.min[axis] - p[axis], p[axis] - box.max[axis]); };
  return dimension == 2 ? box_distance({beyond(0), beyond(1)}) : box_distance({beyond(0), beyond(1), beyond(2)});
}

double distance_to(const Sphere& sphere, Vec3d p, int dimension) {
  return length(flat(p - sphere.centre, dimension)) - sphere.radius;
}

double distance_to(const Cylinder& cylinder, Vec3d p, int dimension) {
  const Vec3d axis = flat(cylinder.to - cylinder.from, dimension), offset = flat(p - cylinder.from, dimension);
  const double height = length(axis), along = dot(offset, axis) / height;
  if (dimension == 2) {
    return length(offset - std::clamp(along, 0.0, height) / height * axis) - cylinder.radius;
  }
  const double across = length(offset - along / height * axis);
  return box_distance({across - cylinder.radius, std::max(-along, along - height)});
}

double distance_to(const Plane& plane, Vec3d p, int dimension) {
  const Vec3d normal = flat(plane.normal, dimension);
  return dot(p - plane.point, normal) / length(normal);
}

// Axis by axis, how far a cylinder of this axis and radius reaches beyond the centres of its ends.
double cylinder_reach(const Cylinder& cylinder, int axis, int dimension) {
  if (dimension == 2) return cylinder.radius;
  const Vec3d along = cylinder.to - cylinder.from;
  const double share = along[axis] / length(along);
  return cylinder.radius * std::sqrt(std::max(0.0, 1 - share * share));
}

Box whole_bounds(const Shape& shape, int dimension, const Domain& domain) {
  Box box;
  const auto around = [&](const auto& reach) {
    for (int axis = 0; axis < dimension; ++axis) std::tie(box.min[axis], box.max[axis]) = reach(axis);
  };
  using Range = std::pair<double, double>;
  std::visit(
      Overload{[&](const Box& b) { box = b; },
               [&](const Sphere& s) {
                 around([&](int k) { return Range{s.centre[k] - s.radius, s.centre[k] + s.radius}; });
               },
               [&](const Cylinder& c) {
                 around([&](int k) {
                   const double reach = cylinder_reach(c, k, dimension);
                   return Range{std::min(c.from[k], c.to[k]) - reach, std::max(c.from[k], c.to[k]) + reach};
                 });
               },
               [&](const Plane&) {
                 box = {domain.min, domain.max};
               },
               [&](const Mesh& m) {
                 around([&](int k) {
                   Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
                   for (const Vec3d& v : m.mesh->vertices) {
                     range = {std::min(range.first, v[k]), std::max(range.second, v[k])};
                   }
                   return range;
                 });
               },
               [&](const Heightfield& h) {
                 box = {h.min, h.max};
               }},
      shape);
  return box;
}

// Share of points inside, on a lattice over the box.
double lattice_volume(const Shape& shape, int dimension, const Box& box) {
  const ShapeProbe probe(shape, dimension);
  const int n = dimension == 2 ? 256 : 48, layers = dimension == 2 ? 1 : n;
  std::size_t hits = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < layers; ++k) {
        const Vec3d size = box.max - box.min;
        hits +=
            probe.inside(box.min + Vec3d{(i + 0.5) / n * size.x, (j + 0.5) / n * size.y, (k + 0.5) / layers * size.z});
      }
    }
  }
  const Vec3d size = box.max - box.min;
  const double whole = size.x * size.y * (dimension == 3 ? size.z : 1);
  return whole * static_cast<double>(hits) / (static_cast<double>(n) * n * layers);
}

double cylinder_height(const Cylinder& c, int dimension) { return length(flat(c.to - c.from, dimension)); }

}  // namespace

std::string_view shape_name(const Shape& shape) {
  constexpr std::string_view names[] = {"box", "sphere", "cylinder", "plane", "mesh", "heightfield"};
  return names[shape.index()];
}

bool inside(const Shape& shape, Vec3d p, int dimension) { return ShapeProbe(shape, dimension).inside(p); }

ShapeProbe::ShapeProbe(const Shape& shape, int dimension) : shape_(&shape), dimension_(dimension) {
  if (const auto* mesh = std::get_if<Mesh>(&shape)) index_.emplace(mesh->mesh);
}

bool ShapeProbe::inside(Vec3d p) const {
  if (index_) return index_->inside(p);
  return distance(p, 0) < 0;
}

double ShapeProbe::distance(Vec3d p, double limit) const {
  return std::visit(Overload{[&](const Mesh&) {
                               const double distance = index_->distance(p, limit);
                               return index_->inside(p) ? -distance : distance;
                             },
                             [&](const Heightfield& field) { return distance_to_heightfield(field, p, dimension_); },
                             [&](const auto& shape) { return distance_to(shape, p, dimension_); }},
                    *shape_);
}

Box bounds(const Shape& shape, int dimension, const Domain& domain) {
  Box box = whole_bounds(shape, dimension, domain);
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = axis < dimension ? std::max(box.min[axis], domain.min[axis]) : 0;
    box.max[axis] = axis < dimension ? std::min(box.max[axis], domain.max[axis]) : 0;
  }
  return box;
}

Domain domain_around(const Body& body, const Domain& domain) {
  Domain seen = domain;
  seen.min = domain.min - body.motion.most();
  seen.max = domain.max - body.motion.least();
  return seen;
}

double volume(const Shape& shape, int dimension, const Domain& domain) {
  const Box whole = whole_bounds(shape, dimension, domain), part = bounds(shape, dimension, domain);
  bool within = true;
  for (int axis = 0; axis < dimension; ++axis) {
    if (part.max[axis] <= part.min[axis]) return 0;
    within = within && whole.min[axis] == part.min[axis] && whole.max[axis] == part.max[axis];
  }
  const Vec3d size = part.max - part.min;
  if (std::holds_alternative<Box>(shape)) return size.x * size.y * (dimension == 3 ? size.z : 1);
  if (!within) return lattice_volume(shape, dimension, part);
  return std::visit(Overload{[&](const Sphere& s) {
                               return dimension == 2 ? pi * s.radius * s.radius
                                                     : 4 * pi / 3 * s.radius * s.radius * s.radius;
                             },
                             [&](const Cylinder& c) {
                               const double h = cylinder_height(c, dimension), disc = pi * c.radius * c.radius;
                               return dimension == 2 ? disc + 2 * c.radius * h : disc * h;
                             },
                             [&](const Mesh& m) { return signed_volume(*m.mesh); },
                             [&](const auto&) { return lattice_volume(shape, dimension, part); }},
                    shape);
}

double surface_area(const Shape& shape, int dimension, const Domain& domain) {
  const auto box_area = [&](Vec3d size) {
    return dimension == 2 ? 2 * (size.x + size.y) : 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  };
  return std::visit(Overload{[&](const Box& b) { return box_area(b.max - b.min); },
                             [&](const Sphere& s) { return 2 * pi * s.radius * (dimension == 2 ? 1 : 2 * s.radius); },
                             [&](const Cylinder& c) {
                               const double h = cylinder_height(c, dimension), ring = 2 * pi * c.radius;
                               return dimension == 2 ? ring + 2 * h : ring * (h + c.radius);
                             },
                             [&](const Plane&) { return box_area(domain.max - domain.min); },
                             [&](const Mesh& m) { return surface_area(*m.mesh); },
                             [&](const Heightfield& h) {
                               if (dimension == 3) return surface_area(heightfield_mesh(h));
                               double total = box_area(h.max - h.min);
                               for (std::size_t i = 1; i < h.heights.size(); ++i)
                                 total += std::abs(h.heights[i] - h.heights[i - 1]);
                               return total;
                             }},
                    shape);
}

}  // namespace curlew
