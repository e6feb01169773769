#include "sim/surface/vertex_velocity.h"

namespace curlew {

void find_vertex_velocities(const LevelSet& level_set, const Polygoniser& polygoniser, std::span<const Vec3> velocity,
                            SurfaceMesh& mesh) {
  mesh.velocity.resize(mesh.position.size());
  const Vec3 reach = level_set.reach();
  const std::size_t bricks = level_set.bricks().size();
#pragma omp parallel
  {
    LevelSet::Searcher searcher;
    std::vector<Vec3> moving;
#pragma omp for schedule(dynamic, 4)
    for (std::size_t b = 0; b < bricks; ++b) {
      const std::uint32_t begin = polygoniser.first_vertex(b), end = polygoniser.first_vertex(b + 1);
      if (begin == end) continue;
      const auto found = level_set.find_sources(level_set.bricks()[b], searcher);
      moving.clear();
      for (const std::uint32_t j : found) moving.push_back(level_set.mirrored(velocity[level_set.number_of(j)], j));
      for (std::uint32_t v = begin; v < end; ++v) {
        Vec3 sum;
        float weights = 0;
        for (std::size_t k = 0; k < found.size(); ++k) {
          const Vec3 source = level_set.position_of(found[k]), away = mesh.position[v] - source;
          const Vec3 q{away.x / reach.x, away.y / reach.y, away.z / reach.z};
          const float t = 1 - dot(q, q);
          if (t <= 0) continue;
          const float weight = source.w * t * t * t;
          sum += weight * moving[k];
          weights += weight;
        }
        mesh.velocity[v] = weights > 0 ? (1 / weights) * sum : Vec3{};
      }
    }
  }
}

}  // namespace curlew
