// Marching cubes over the bricks of a level set: vertices on the grid's edges where phi crosses zero, shared between
// the cells around, and triangles between them. Closed, each edge in exactly two triangles, the same bytes on any
// number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/surface/level_set.h"
#include "sim/surface/surface_mesh.h"

namespace curlew {

class Polygoniser {
 public:
  // From the gradient of phi, or along the grid's edge, where smoothing makes them anew.
  enum class Normals { gradient, straight };

  // Fills mesh.position, mesh.normal and mesh.triangles.
  void run(const LevelSet& level_set, Normals normals, SurfaceMesh& mesh);

  // Vertices of brick b are first_vertex(b) to first_vertex(b + 1).
  std::uint32_t first_vertex(std::size_t brick) const { return marks_[brick].first_vertex; }
  std::size_t bytes() const { return marks_.capacity() * sizeof(Marks); }

 private:
  using Bits = LevelSet::Bits;

  // What a brick owns: the grid edges that start at its points, and the cells whose lowest corner they are.
  struct Marks {
    std::array<Bits, 3> crossed;                         // edges along x, y, z
    std::array<std::array<std::uint16_t, 8>, 3> before;  // crossed edges of the brick before a word
    Bits cells;                                          // that hold triangles
    std::uint32_t vertices, triangles;                   // how many
    std::uint32_t first_vertex, first_triangle;
  };

  void mark(const LevelSet& level_set, std::size_t b);
  void make_vertices(const LevelSet& level_set, std::size_t b, Normals normals, SurfaceMesh& mesh) const;
  void make_triangles(const LevelSet& level_set, std::size_t b, SurfaceMesh& mesh) const;
  std::uint32_t vertex(std::size_t brick, int axis, int x, int bit) const;

  std::vector<Marks> marks_;
};

}  // namespace curlew
