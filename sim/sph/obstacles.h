// The shapes of the bodies as the last line that no particle crosses. Their samples (bodies.h) push by density, and a
// drop that meets them alone has none: it is stopped at the surface.
//
// Bodies that move are looked at in their own coordinates. `places` says where they are, one for each body of the
// scene; where it is empty, all are where the scene has them.
#pragma once

#include <span>
#include <vector>

#include "sim/core/vec.h"
#include "sim/scene/scene.h"
#include "sim/scene/shapes.h"

namespace curlew {

class Obstacles {
 public:
  explicit Obstacles(const Scene& scene);
  Obstacles(const Obstacles&) = delete;  // the probes point at the shapes
  Obstacles& operator=(const Obstacles&) = delete;

  bool contains(Vec3 x, std::span<const BodyPlace> places = {}) const;

  // Puts a particle that has gone into a body back on its surface and takes away the velocity into it, as the body
  // sees it: one that comes towards the particle pushes it. True where it
  // did. Where there is no free place near by, as between two bodies, the particle goes back to `before`.
  bool hold(Vec3& x, Vec3& v, Vec3 before, std::span<const BodyPlace> places = {}) const;

 private:
  struct Obstacle {
    Box bounds;
    ShapeProbe probe;
  };
  // A body with a point in it, and where it is.
  struct Found {
    const Obstacle* body = nullptr;
    BodyPlace place;
  };
  Found around(Vec3 x, std::span<const BodyPlace> places) const;

  int dimension_;
  double spacing_;
  std::vector<Shape> shapes_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace curlew
