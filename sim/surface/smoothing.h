// Smoothing of a surface mesh that keeps its volume (Taubin 1995, "A signal processing approach to fair surface
// design"): a step towards the mean of the neighbours, and one back by a little more. Bumps as small as a particle go,
// what is larger stays.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/core/simd.h"
#include "sim/scene/scene.h"
#include "sim/surface/polygonise.h"

namespace curlew {

class Smoother {
 public:
  // Moves mesh.position `passes` times and makes mesh.normal anew from the triangles around. Vertices in a face of the
  // domain at which the water ends stay in it, and drops of a few triangles, which smoothing would shrink, keep their
  // shape. The mesh must be closed.
  void run(SurfaceMesh& mesh, int passes, const Domain& domain);
  std::size_t bytes() const;

 private:
  void find_rings(const SurfaceMesh& mesh);
  f4 moved(std::size_t v, f4 here, f4 to_mean, float share) const;
  void first_step(const std::vector<Vec3>& from, std::vector<Vec3>& to);
  void step(const std::vector<Vec3>& from, std::vector<Vec3>& to, float share) const;
  void find_normals(SurfaceMesh& mesh) const;

  std::vector<std::uint32_t> first_;            // of a vertex's triangles in the next two
  std::vector<std::uint32_t> next_, previous_;  // their other corners
  std::vector<float> freedom_;
  std::vector<Vec3> other_;
  Vec3 low_, high_;                 // where the water must end, m
  Vec3 near_;                       // m: a vertex as near as this lies in such a face
  std::vector<std::uint8_t> held_;  // bit an axis along which the vertex must not move
};

}  // namespace curlew
