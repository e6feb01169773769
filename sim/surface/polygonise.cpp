// Reference: Lorensen & Cline 1987, "Marching cubes: a high resolution 3D surface construction algorithm".
//
// A brick's 512 points are eight words of 64 bits, one for each x, with bit 8 y + z. Which edges cross the surface is
// then a shift and an exclusive or away, 64 at a time.
#include "sim/surface/polygonise.h"

#include <algorithm>
#include <bit>

#include "sim/core/simd.h"
#include "sim/surface/marching_cubes.h"

namespace curlew {
namespace {

constexpr int side = LevelSet::side;
constexpr std::uint64_t last_z = 0x8080808080808080u;  // bits with z = 7
using Bits = LevelSet::Bits;

// The words of a brick and of those after it, as far as cells reach: word x of (y, z) shifted by one where asked.
class BitsAround {
 public:
  BitsAround(const LevelSet& level_set, const LevelSet::Brick& brick) {
    for (int dx = 0; dx < 2; ++dx) {
      for (int dy = 0; dy < 2; ++dy) {
        for (int dz = 0; dz < 2; ++dz) {
          const auto b = brick.beside(dx, dy, dz);
          bits_[dx][dy][dz] = b < 0 ? nullptr : &level_set.inside(static_cast<std::size_t>(b));
        }
      }
    }
  }

  // Bit (y, z) says whether the point (x + dx, y + dy, z + dz) is inside, for dy and dz 0 or 1.
  std::uint64_t corner(int x, int dy, int dz) const {
    const int over = x / side;
    const auto at = static_cast<std::size_t>(x % side);
    std::uint64_t word = shifted_z(over, 0, at, dz);
    if (dy == 0) return word;
    return word >> 8 | shifted_z(over, 1, at, dz) << 56;
  }

 private:
  std::uint64_t word(int dx, int dy, int dz, std::size_t x) const {
    const Bits* bits = bits_[dx][dy][dz];
    return bits == nullptr ? 0 : (*bits)[x];
  }
  std::uint64_t shifted_z(int dx, int dy, std::size_t x, int dz) const {
    const std::uint64_t here = word(dx, dy, 0, x);
    if (dz == 0) return here;
    return (here >> 1 & ~last_z) | (word(dx, dy, 1, x) << 7 & last_z);
  }

  const Bits* bits_[2][2][2];
};

// The eight corners of all cells with the same x: word c has a bit a cell.
std::array<std::uint64_t, 8> corner_words(const BitsAround& bits, int x) {
  std::array<std::uint64_t, 8> words;
  for (int c = 0; c < 8; ++c) words[static_cast<std::size_t>(c)] = bits.corner(x + (c >> 2), c >> 1 & 1, c & 1);
  return words;
}

std::size_t case_of(const std::array<std::uint64_t, 8>& corners, int bit) {
  std::size_t index = 0;
  for (std::size_t c = 0; c < 8; ++c) index |= (corners[c] >> bit & 1u) << c;
  return index;
}

// A brick's values with a rim: one point before, two after, so that gradients at both ends of its edges are differences
// of neighbours. Rows along z are 16 long, the brick's own points from place 8 on.
class Padded {
 public:
  void fill(const LevelSet& level_set, const LevelSet::Brick& brick) {
    for (int x = -1; x < side + 2; ++x) {
      for (int y = -1; y < side + 2; ++y) {
        float* row = &values_[index(x, y, 0)];
        for (int dz = -1; dz <= 1; ++dz) {
          const auto b = brick.beside(over(x), over(y), dz);
          const float* from =
              b < 0 ? nullptr : level_set.values(static_cast<std::size_t>(b)) + 64 * (x & 7) + 8 * (y & 7);
          const auto value = [&](int z) { return from == nullptr ? level_set.value_outside() : from[z]; };
          if (dz < 0) row[-1] = value(side - 1);
          if (dz == 0) {
            for (int z = 0; z < side; ++z) row[z] = value(z);
          }
          if (dz > 0) row[side] = value(0), row[side + 1] = value(1);
        }
      }
    }
  }

  float value(int at) const { return values_[at]; }
  static constexpr int index(int x, int y, int z) { return ((x + 1) * rows + y + 1) * length + z + 8; }
  static constexpr int stride(int axis) { return axis == 0 ? rows * length : axis == 1 ? length : 1; }

  // Twice the difference quotient, in units of the grid.
  Vec3 gradient(int at) const {
    const auto along = [&](int step) { return values_[at + step] - values_[at - step]; };
    return {along(stride(0)), along(stride(1)), along(stride(2))};
  }

 private:
  static constexpr int rows = side + 3, length = 24;
  static int over(int p) { return p < 0 ? -1 : p < side ? 0 : 1; }
  float values_[rows * rows * length];
};

}  // namespace

void Polygoniser::mark(const LevelSet& level_set, std::size_t b) {
  const BitsAround bits(level_set, level_set.bricks()[b]);
  const auto& table = marching_cubes_table();
  Marks& m = marks_[b];
  m.vertices = m.triangles = 0;
  for (int x = 0; x < side; ++x) {
    const auto w = static_cast<std::size_t>(x);
    const auto corners = corner_words(bits, x);
    std::uint64_t all = ~std::uint64_t{0}, any = 0;
    for (const std::uint64_t word : corners) all &= word, any |= word;
    m.cells[w] = any & ~all;
    for (std::uint64_t cells = m.cells[w]; cells != 0; cells &= cells - 1)
      m.triangles += static_cast<std::uint32_t>(table[case_of(corners, std::countr_zero(cells))].count);
    for (std::size_t axis = 0; axis < 3; ++axis)
      m.crossed[axis][w] = corners[0] ^ corners[static_cast<std::size_t>(axis_bit(static_cast<int>(axis)))];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t w = 0; w < side; ++w) {
      m.before[axis][w] = static_cast<std::uint16_t>(m.vertices);
      m.vertices += static_cast<std::uint32_t>(std::popcount(m.crossed[axis][w]));
    }
  }
}

std::uint32_t Polygoniser::vertex(std::size_t brick, int axis, int x, int bit) const {
  const Marks& m = marks_[brick];
  const auto a = static_cast<std::size_t>(axis), w = static_cast<std::size_t>(x);
  const std::uint64_t lower = m.crossed[a][w] & ((std::uint64_t{1} << bit) - 1);
  return m.first_vertex + m.before[a][w] + static_cast<std::uint32_t>(std::popcount(lower));
}

void Polygoniser::make_vertices(const LevelSet& level_set, std::size_t b, Normals normals, SurfaceMesh& mesh) const {
  const Marks& m = marks_[b];
  if (m.vertices == 0) return;
  const LevelSet::Brick& brick = level_set.bricks()[b];
  Padded padded;
  padded.fill(level_set, brick);
  const Vec3d cell = level_set.cell();
  const Vec3 per_cell = to_float({1 / cell.x, 1 / cell.y, 1 / cell.z});
  std::size_t v = m.first_vertex;
  for (int axis = 0; axis < 3; ++axis) {
    for (int x = 0; x < side; ++x) {
      for (std::uint64_t word = m.crossed[static_cast<std::size_t>(axis)][static_cast<std::size_t>(x)]; word != 0;
           word &= word - 1, ++v) {
        const int bit = std::countr_zero(word), y = bit / side, z = bit % side;
        const int from = Padded::index(x, y, z), to = from + Padded::stride(axis);
        const float here = padded.value(from), there = padded.value(to);
        // Not quite to the ends, where triangles would have no area.
        const float t = std::clamp(here / (here - there), 0.01f, 0.99f);
        Vec3 p{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        p[axis] += t;
        mesh.position[v] = level_set.place(brick, p.x, p.y, p.z);
        Vec3 straight;
        straight[axis] = here > there ? 1.0f : -1.0f;
        mesh.normal[v] = straight;
        if (normals == Normals::straight) continue;
        const Vec3 g = (1 - t) * padded.gradient(from) + t * padded.gradient(to);
        const Vec3 n{-g.x * per_cell.x, -g.y * per_cell.y, -g.z * per_cell.z};
        const float l = length(n);
        if (l > 0) mesh.normal[v] = (1 / l) * n;
      }
    }
  }
}

void Polygoniser::make_triangles(const LevelSet& level_set, std::size_t b, SurfaceMesh& mesh) const {
  const Marks& m = marks_[b];
  if (m.triangles == 0) return;
  const LevelSet::Brick& brick = level_set.bricks()[b];
  const BitsAround bits(level_set, brick);
  const auto& table = marching_cubes_table();
  std::size_t t = m.first_triangle;
  for (int x = 0; x < side; ++x) {
    const auto w = static_cast<std::size_t>(x);
    if (m.cells[w] == 0) continue;
    const auto corners = corner_words(bits, x);
    for (std::uint64_t cells = m.cells[w]; cells != 0; cells &= cells - 1) {
      const int bit = std::countr_zero(cells), y = bit / side, z = bit % side;
      const CellTriangles& found = table[case_of(corners, bit)];
      for (int k = 0; k < found.count; ++k) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const int edge = found.edges[static_cast<std::size_t>(k)][corner], low = edge_corner(edge);
          const int px = x + (low >> 2), py = y + (low >> 1 & 1), pz = z + (low & 1);
          const auto owner = brick.beside(px / side, py / side, pz / side);
          mesh.triangles[t][corner] =
              vertex(static_cast<std::size_t>(owner), edge_axis(edge), px % side, side * (py % side) + pz % side);
        }
        ++t;
      }
    }
  }
}

void Polygoniser::run(const LevelSet& level_set, Normals normals, SurfaceMesh& mesh) {
  const std::size_t bricks = level_set.bricks().size();
  marks_.resize(bricks + 1);
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t b = 0; b < bricks; ++b) mark(level_set, b);
  marks_[bricks].vertices = marks_[bricks].triangles = 0;
  std::uint32_t vertices = 0, triangles = 0;
  for (Marks& m : marks_) {
    m.first_vertex = vertices;
    m.first_triangle = triangles;
    vertices += m.vertices;
    triangles += m.triangles;
  }
  mesh.position.resize(vertices);
  mesh.normal.resize(vertices);
  mesh.triangles.resize(triangles);
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t b = 0; b < bricks; ++b) {
    make_vertices(level_set, b, normals, mesh);
    make_triangles(level_set, b, mesh);
  }
}

}  // namespace curlew
