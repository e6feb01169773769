// The table of marching cubes (Lorensen & Cline 1987), derived rather than listed: 256 ways in which the eight corners
// of a cell lie inside or outside, each with its triangles.
//
// Corner c has its offsets along x, y, z in bits 2, 1, 0 of c. Edge e runs along axis e / 4 from corner edge_corner(e).
// On a face whose corners alternate the inside is joined, in both cells that share the face, so surfaces close; and no
// triangle has a side that crosses a face, so two cells never share one inside a face: every edge of the mesh belongs
// to exactly two triangles.
#pragma once

#include <array>
#include <cstdint>

namespace curlew {

struct CellTriangles {
  int count = 0;                                       // triangles, at most 5
  std::array<std::array<std::uint8_t, 3>, 5> edges{};  // where their corners lie, counter-clockwise from outside
};

// Index: bit c is set where corner c is inside.
const std::array<CellTriangles, 256>& marching_cubes_table();

// The corner at the lower end of an edge; the upper end is that corner with the bit of the edge's axis set.
constexpr int edge_axis(int edge) { return edge / 4; }
constexpr int axis_bit(int axis) { return 4 >> axis; }
constexpr int edge_corner(int edge) {
  const int axis = edge / 4, k = edge % 4, low = axis_bit(axis) - 1;
  return ((k & ~low) << 1) | (k & low);
}

}  // namespace curlew
