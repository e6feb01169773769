// Sources in the shape of their surroundings: flat at a surface and in a sheet, long in a jet, round in the midst of
// water and alone (Yu & Turk 2013, "Reconstructing surfaces of particle-based fluids using anisotropic kernels").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/sph/grid.h"
#include "sim/surface/images.h"
#include "sim/surface/level_set.h"

namespace curlew {

class ShapeFinder {
 public:
  // Fills in a shape for each source, no axis longer than `radius` (m), and raises its peak w so that the integral of
  // its kernel stays. `spacing` in m.
  //
  // The paper's axes go with the covariance of the neighbours, ours with its root, the neighbourhood's true shape; and
  // the paper moves particles towards their neighbours' mean, which takes most of a layer of particles off a ball of
  // water, and we do not.
  void run(std::span<Vec3> sources, const Domain& domain, double spacing, double radius,
           std::vector<SourceShape>& shapes);
  std::size_t bytes() const;

 private:
  std::vector<Vec3> unsorted_, position_;
  std::vector<ImageOrigin> origin_;
  std::vector<std::uint32_t> order_;
  Grid grid_;
};

}  // namespace curlew
