// One even layer of samples on analytic surfaces: regular grids whose spacing divides each edge. Meshes and
// heightfields are sampled in sample_mesh.cpp.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/scene/heightfield.h"
#include "sim/scene/point_grid.h"
#include "sim/scene/sample_mesh.h"
#include "sim/scene/sampling.h"
#include "sim/scene/shapes.h"

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;

// The number of parts into which a length is cut: nearest to the spacing, but never longer than 1.2 spacings; 0 where
// the length is so short that its two ends are one place.
int parts(double length, double spacing) {
  const double ratio = length / spacing;
  if (ratio < 0.6) return 0;
  const double nearest = std::max(1.0, std::round(ratio));
  return static_cast<int>(ratio > 1.2 * nearest ? nearest + 1 : nearest);
}

// Points along a line from `from` to `to`, both ends included.
double along(double from, double to, int i, int count) {
  return count == 0 ? (from + to) / 2 : i == count ? to : from + (to - from) * i / count;
}

struct Sampler {
  double d;
  int dimension;
  const Domain& domain;
  std::vector<Vec3d> points;

  // The range of i for which along(...) lies within the domain and two spacings more: a box may be far larger.
  std::pair<int, int> near_domain(double from, double to, int count, int axis) const {
    if (count == 0) return {0, 0};
    const double step = (to - from) / count;
    const double begin = std::ceil((domain.min[axis] - 2 * d - from) / step),
                 end = std::floor((domain.max[axis] + 2 * d - from) / step);
    return {static_cast<int>(std::clamp(begin, 0.0, count + 1.0)),
            static_cast<int>(std::clamp(end, -1.0, count * 1.0))};
  }

  void operator()(const Box& b) {
    int n[3] = {0, 0, 0};
    std::pair<int, int> range[3];
    for (int k = 0; k < dimension; ++k) {
      n[k] = parts(b.max[k] - b.min[k], d);
      range[k] = near_domain(b.min[k], b.max[k], n[k], k);
    }
    const auto at_face = [&](int i, int k) { return k < dimension && (i == 0 || i == n[k]); };
    for (int i = range[0].first; i <= range[0].second; ++i) {
      for (int j = range[1].first; j <= range[1].second; ++j) {
        const bool whole = at_face(i, 0) || at_face(j, 1);
        const int skip = whole || n[2] == 0 ? 1 : n[2];  // in the interior only the two ends along z
        for (int k = whole || dimension == 2 ? range[2].first : 0; k <= (whole ? range[2].second : n[2]); k += skip) {
          if (!whole && !at_face(k, 2)) continue;
          points.push_back({along(b.min.x, b.max.x, i, n[0]), along(b.min.y, b.max.y, j, n[1]),
                            dimension == 3 ? along(b.min.z, b.max.z, k, n[2]) : 0});
        }
      }
    }
  }

  void circle(Vec3d centre, Vec3d u, Vec3d v, double radius, double phase) {
    const int n = std::max(1, static_cast<int>(std::round(2 * pi * radius / d)));
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * pi * (k + phase) / n;
      points.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }

  // Fibonacci lattice (Swinbank & Purser 2006), its poles moved inwards so that no two points crowd there.
  void operator()(const Sphere& s) {
    if (dimension == 2) return circle({s.centre.x, s.centre.y, 0}, {1, 0, 0}, {0, 1, 0}, s.radius, 0);
    const int n = std::max(1, static_cast<int>(std::round(4 * pi * s.radius * s.radius / (d * d))));
    constexpr double golden_angle = pi * (3 - 2.23606797749978969641), inset = 0.36;
    for (int k = 0; k < n; ++k) {
      const double y = n == 1 ? 1 : 1 - 2 * (k + inset) / (n - 1 + 2 * inset);
      const double ring = std::sqrt(std::max(0.0, 1 - y * y)), angle = golden_angle * k;
      points.push_back(s.centre + s.radius * Vec3d{ring * std::cos(angle), y, ring * std::sin(angle)});
    }
  }

  // Rings up the side, each turned by half a step against the one below, and rings within rings on the end faces.
  void operator()(const Cylinder& c) {
    if (dimension == 2) return strip(c);
    const Vec3d whole = c.to - c.from, axis = (1 / length(whole)) * whole;
    const Vec3d other = std::abs(axis.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    Vec3d u = cross(axis, other);
    u = (1 / length(u)) * u;
    const Vec3d v = cross(axis, u);
    const int rows = parts(length(whole), d), rings = static_cast<int>(std::round(c.radius / d));
    for (int row = 0; row <= rows; ++row) {
      const Vec3d centre = c.from + (rows == 0 ? 0.5 : static_cast<double>(row) / rows) * whole;
      circle(centre, u, v, c.radius, row % 2 == 0 ? 0 : 0.5);
      if (row != 0 && row != rows) continue;
      for (int ring = rings - 1; ring >= 1; --ring)
        circle(centre, u, v, c.radius * ring / rings, 0.5 * ((rings - ring) % 2));
      if (c.radius >= 0.6 * d) points.push_back(centre);
    }
  }

  // The outline of a 2D strip with round ends, cut into equal parts.
  void strip(const Cylinder& c) {
    const double dx = c.to.x - c.from.x, dy = c.to.y - c.from.y, straight = std::hypot(dx, dy), bend = pi * c.radius;
    const double tx = dx / straight, ty = dy / straight, r = c.radius;
    const int n = std::max(1, static_cast<int>(std::round(2 * (straight + bend) / d)));
    const auto half = [&](double s, Vec3d start, double side) {  // along one side, then around its end
      const double angle = r > 0 ? std::max(0.0, s - straight) / r : 0,
                   forward = std::min(s, straight) + r * std::sin(angle);
      const double out = r * std::cos(angle);
      points.push_back({start.x + side * (forward * tx + out * ty), start.y + side * (forward * ty - out * tx), 0});
    };
    for (int k = 0; k < n; ++k) {
      const double s = 2 * (straight + bend) * k / n;
      if (s < straight + bend) half(s, c.from, 1);
      if (s >= straight + bend) half(s - straight - bend, c.to, -1);
    }
  }

  // Points where the plane cuts the edges of the domain.
  std::vector<Vec3d> section(const Plane& plane) const {
    std::vector<Vec3d> cuts;
    for (int axis = 0; axis < dimension; ++axis) {
      for (int corner = 0; corner < (dimension == 2 ? 2 : 4); ++corner) {
        Vec3d a = domain.min;
        const int second = (axis + 1) % dimension, third = (axis + 2) % dimension;
        if ((corner & 1) != 0) a[second] = domain.max[second];
        if ((corner & 2) != 0) a[third] = domain.max[third];
        Vec3d b = a;
        b[axis] = domain.max[axis];
        const double da = dot(a - plane.point, plane.normal), db = dot(b - plane.point, plane.normal);
        if ((da <= 0) != (db <= 0) || da * db == 0) cuts.push_back(da == db ? a : a + da / (da - db) * (b - a));
      }
    }
    return cuts;
  }

  void operator()(Plane plane) {
    if (dimension == 2) plane.normal.z = plane.point.z = 0;
    plane.normal = (1 / length(plane.normal)) * plane.normal;
    const std::vector<Vec3d> cuts = section(plane);
    if (cuts.empty()) return;
    // Directions in the plane: u along the coordinate axis that lies nearest to it, v across.
    int flattest = 0;
    for (int axis = 1; axis < dimension; ++axis) {
      if (std::abs(plane.normal[axis]) < std::abs(plane.normal[flattest])) flattest = axis;
    }
    Vec3d u;
    u[flattest] = 1;
    u = u - dot(u, plane.normal) * plane.normal;
    u = (1 / length(u)) * u;
    const Vec3d v = dimension == 2 ? Vec3d{} : cross(plane.normal, u);
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const Vec3d& p : cuts) {
      const double at[2] = {dot(p - plane.point, u), dot(p - plane.point, v)};
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], at[k]);
        high[k] = std::max(high[k], at[k]);
      }
    }
    const int nu = parts(high[0] - low[0], d), nv = dimension == 2 ? 0 : parts(high[1] - low[1], d);
    for (int i = 0; i <= nu; ++i) {
      for (int j = 0; j <= nv; ++j) {
        const Vec3d p = plane.point + along(low[0], high[0], i, nu) * u + along(low[1], high[1], j, nv) * v;
        if (within(p, 1e-9 + 1.01 * d)) points.push_back(p);
      }
    }
  }

  void operator()(const Mesh& m) { points = sample_mesh(*m.mesh, d, domain); }

  void operator()(const Heightfield& field) {
    if (dimension == 3) {
      points = sample_mesh(heightfield_mesh(field), d, domain);
    } else {
      points = sample_outline(field, d, domain);
    }
  }

  bool within(Vec3d p, double margin) const {
    for (int axis = 0; axis < dimension; ++axis) {
      if (p[axis] < domain.min[axis] - margin || p[axis] > domain.max[axis] + margin) return false;
    }
    return true;
  }
};

// Shapes whose surface lies `depth` beneath that of the given one; thin parts end in their middle.
Shape beneath(const Box& b, double depth, int dimension) {
  Box inner = b;
  for (int axis = 0; axis < dimension; ++axis) {
    const double inset = std::min(depth, (b.max[axis] - b.min[axis]) / 2);
    inner.min[axis] += inset;
    inner.max[axis] -= inset;
  }
  return inner;
}

Shape beneath(const Sphere& s, double depth, int) { return Sphere{s.centre, std::max(0.0, s.radius - depth)}; }

Shape beneath(const Cylinder& c, double depth, int dimension) {
  const Vec3d whole = c.to - c.from;
  // In 2D the ends are round, and shrink with the radius.
  const Vec3d inset = dimension == 2 ? Vec3d{} : std::min(depth / length(whole), 0.4999) * whole;
  return Cylinder{c.from + inset, c.to - inset, std::max(0.0, c.radius - depth)};
}

Shape beneath(const Plane& plane, double depth, int dimension) {
  const Vec3d normal = dimension == 2 ? Vec3d{plane.normal.x, plane.normal.y, 0} : plane.normal;
  return Plane{plane.point - depth / length(normal) * normal, plane.normal};
}

// The place `depth` beneath p on the surface, or as near to it as there is along the normal.
Vec3d pushed_in(const ShapeProbe& probe, Vec3d p, double depth, int dimension) {
  const double reach = 4 * depth;
  Vec3d normal;
  for (int axis = 0; axis < dimension; ++axis) {
    Vec3d step;
    step[axis] = 0.25 * depth;
    normal[axis] = probe.distance(p + step, reach) - probe.distance(p - step, reach);
  }
  if (length(normal) == 0) return p;
  normal = (1 / length(normal)) * normal;
  Vec3d best = p;
  double least = INFINITY;
  for (int part = 0; part <= 7; ++part) {  // to 1.75 depths: a corner's normal leads in slantwise
    const Vec3d place = p - 0.25 * part * depth * normal;
    const double miss = std::abs(probe.distance(place, reach) + depth);
    if (miss < least - 1e-6 * depth) {
      least = miss;
      best = place;
    }
  }
  return best;
}

// One layer at that depth beneath the surface.
std::vector<Vec3d> sample_beneath(const Shape& shape, double depth, double spacing, int dimension,
                                  const Domain& domain) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (requires { beneath(kind, depth, dimension); }) {
          return sample_surface(beneath(kind, depth, dimension), spacing, dimension, domain);
        } else {
          const ShapeProbe probe(shape, dimension);
          std::vector<Vec3d> points = sample_surface(shape, spacing, dimension, domain);
          for (Vec3d& p : points) p = pushed_in(probe, p, depth, dimension);
          return points;
        }
      },
      shape);
}

}  // namespace

std::vector<Vec3d> sample_surface(const Shape& shape, double spacing, int dimension, const Domain& domain) {
  Sampler sampler{spacing, dimension, domain, {}};
  std::visit(sampler, shape);
  bool wraps = false;
  std::erase_if(sampler.points, [&](Vec3d p) {
    for (int axis = 0; axis < dimension; ++axis) {
      const bool periodic = domain.periodic[static_cast<std::size_t>(axis)];
      wraps = wraps || periodic;
      if (periodic && (p[axis] < domain.min[axis] || p[axis] >= domain.max[axis])) return true;
    }
    return !sampler.within(p, 2 * spacing);
  });
  return wraps ? thinned(sampler.points, 0.6 * spacing * (1 - 1e-9), domain) : std::move(sampler.points);
}

std::vector<Vec3d> sample_body(const Shape& shape, double spacing, int dimension, const Domain& domain) {
  std::vector<Vec3d> points;
  for (const double depth : {0.5 * spacing, 1.5 * spacing}) {
    const std::vector<Vec3d> layer = sample_beneath(shape, depth, spacing, dimension, domain);
    points.insert(points.end(), layer.begin(), layer.end());
  }
  return thinned(points, 0.6 * spacing * (1 - 1e-9), domain);
}

}  // namespace curlew
