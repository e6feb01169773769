// The shapes of the bodies as the last line that no particle crosses. Their samples (bodies.h) push by density, and a
// drop that meets them alone has none: it is stopped at the surface.
#pragma once

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

  bool contains(Vec3 x) const;

  // Puts a particle that has gone into a body back on its surface and takes away the velocity into it; true where it
  // did. Where there is no free place near by, as between two bodies, the particle goes back to `before`.
  bool hold(Vec3& x, Vec3& v, Vec3 before) const;

 private:
  struct Obstacle {
    Box bounds;
    ShapeProbe probe;
  };
  const Obstacle* around(Vec3 x) const;

  int dimension_;
  double spacing_;
  std::vector<Shape> shapes_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace curlew
