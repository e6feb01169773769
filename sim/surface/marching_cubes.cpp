#include "sim/surface/marching_cubes.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace curlew {
namespace {

using Loop = std::vector<int>;  // edges of the cell, in order around a piece of surface

// The edge between two neighbouring corners.
int edge_between(int a, int b) {
  const int low = a & b;
  for (int edge = 0; edge < 12; ++edge) {
    if (edge_corner(edge) == low && (a ^ b) == axis_bit(edge_axis(edge))) return edge;
  }
  return -1;
}

// The four corners of a face, counter-clockwise seen from outside the cell.
std::array<int, 4> face_corners(int axis, bool high) {
  const int a = axis_bit((axis + 1) % 3), b = axis_bit((axis + 2) % 3), at = high ? axis_bit(axis) : 0;
  std::array<int, 4> corners{at, at | a, at | a | b, at | b};
  if (!high) std::reverse(corners.begin(), corners.end());
  return corners;
}

bool share_a_face(int edge, int other) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      const auto on_face = [&](int e) {
        return edge_axis(e) != axis && ((edge_corner(e) & axis_bit(axis)) != 0) == high;
      };
      if (on_face(edge) && on_face(other)) return true;
    }
  }
  return false;
}

// Walks around each face: the piece of surface there runs from where the walk enters the inside back to where it last
// left it, so that the inside of a face with alternating corners is joined. The face beyond walks the shared edge the
// other way, so pieces link up to loops.
std::vector<Loop> surface_loops(int inside) {
  std::array<int, 12> next;
  next.fill(-1);
  const auto is_inside = [&](int corner) { return (inside >> corner & 1) != 0; };
  for (int face = 0; face < 6; ++face) {
    const auto corners = face_corners(face / 2, face % 2 == 1);
    const auto corner = [&](int k) { return corners[static_cast<std::size_t>((k + 4) % 4)]; };
    for (int k = 0; k < 4; ++k) {
      if (is_inside(corner(k)) || !is_inside(corner(k + 1))) continue;
      int left = k - 1;
      while (!is_inside(corner(left)) || is_inside(corner(left + 1))) --left;
      next[static_cast<std::size_t>(edge_between(corner(k), corner(k + 1)))] =
          edge_between(corner(left), corner(left + 1));
    }
  }
  std::vector<Loop> loops;
  std::array<bool, 12> seen{};
  for (int first = 0; first < 12; ++first) {
    Loop loop;
    for (int e = first; next[static_cast<std::size_t>(e)] >= 0 && !seen[static_cast<std::size_t>(e)];
         e = next[static_cast<std::size_t>(e)]) {
      seen[static_cast<std::size_t>(e)] = true;
      loop.push_back(e);
    }
    if (!loop.empty()) loops.push_back(loop);
  }
  return loops;
}

// Squared distance between the middles of two edges, in quarter cells.
int distance2(int edge, int other) {
  int sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = [&](int e) { return edge_axis(e) == axis ? 1 : (edge_corner(e) & axis_bit(axis)) != 0 ? 2 : 0; };
    sum += (at(edge) - at(other)) * (at(edge) - at(other));
  }
  return sum;
}

struct Cover {
  int cost = 0;
  std::vector<std::array<std::uint8_t, 3>> triangles;
};

// The cheapest way to fill the loop's part from `first` to `last` with triangles, all sides inside the cell.
std::optional<Cover> fill(const Loop& loop, std::size_t first, std::size_t last) {
  if (last - first < 2) return Cover{};
  const auto side = [&](std::size_t a, std::size_t b) -> std::optional<int> {
    if (b - a == 1) return 0;  // a piece of the loop itself
    if (share_a_face(loop[a], loop[b])) return std::nullopt;
    return distance2(loop[a], loop[b]);
  };
  std::optional<Cover> best;
  for (std::size_t k = first + 1; k < last; ++k) {
    const auto left_side = side(first, k), right_side = side(k, last);
    if (!left_side || !right_side) continue;
    auto left = fill(loop, first, k), right = fill(loop, k, last);
    if (!left || !right) continue;
    const int cost = left->cost + right->cost + *left_side + *right_side;
    if (best && best->cost <= cost) continue;
    best = Cover{cost, std::move(left->triangles)};
    best->triangles.insert(best->triangles.end(), right->triangles.begin(), right->triangles.end());
    best->triangles.push_back({static_cast<std::uint8_t>(loop[first]), static_cast<std::uint8_t>(loop[k]),
                               static_cast<std::uint8_t>(loop[last])});
  }
  return best;
}

std::array<CellTriangles, 256> make_table() {
  std::array<CellTriangles, 256> table;
  for (int inside = 0; inside < 256; ++inside) {
    CellTriangles& cell = table[static_cast<std::size_t>(inside)];
    for (const Loop& loop : surface_loops(inside)) {
      const auto cover = fill(loop, 0, loop.size() - 1);  // there is one for each loop of each case; a test holds it
      for (const auto& triangle : cover->triangles) cell.edges[static_cast<std::size_t>(cell.count++)] = triangle;
    }
  }
  return table;
}

}  // namespace

const std::array<CellTriangles, 256>& marching_cubes_table() {
  static const std::array<CellTriangles, 256> table = make_table();
  return table;
}

}  // namespace curlew
