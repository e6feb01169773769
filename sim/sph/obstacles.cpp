#include "sim/sph/obstacles.h"

namespace curlew {

Obstacles::Obstacles(const Scene& scene) : dimension_(scene.dimension), spacing_(scene.spacing()) {
  for (const Body& body : scene.bodies) shapes_.push_back(body.shape);
  for (const Shape& shape : shapes_) {
    obstacles_.push_back({bounds(shape, dimension_, scene.domain), ShapeProbe(shape, dimension_)});
  }
}

const Obstacles::Obstacle* Obstacles::around(Vec3 x) const {
  const Vec3d p = to_double(x);
  for (const Obstacle& obstacle : obstacles_) {
    const Box& box = obstacle.bounds;
    bool near = true;
    for (int axis = 0; axis < dimension_; ++axis) near = near && p[axis] >= box.min[axis] && p[axis] <= box.max[axis];
    if (near && obstacle.probe.inside(p)) return &obstacle;
  }
  return nullptr;
}

bool Obstacles::contains(Vec3 x) const { return around(x) != nullptr; }

bool Obstacles::hold(Vec3& x, Vec3& v, Vec3 before) const {
  const Obstacle* body = around(x);
  if (body == nullptr) return false;
  const double reach = 8 * spacing_, step = 0.01 * spacing_, clear = 1e-4 * spacing_;
  Vec3d p = to_double(x);
  for (int attempt = 0; attempt < 4 && body != nullptr; ++attempt) {
    const auto distance = [&](Vec3d q) { return body->probe.distance(q, reach); };
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
    const float into = dot(v, n);
    if (into < 0) v = v - into * n;
    body = around(to_float(p));
  }
  x = body == nullptr ? to_float(p) : before;
  return true;
}

}  // namespace curlew
