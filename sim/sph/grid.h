// A uniform grid of which only occupied cells exist. Particles are sorted by cell, so a row of cells along z is one run
// of consecutive particles; there is no array over the domain, so its size does not matter, and a far outlier costs
// nothing. Cells are as wide as the kernel's support: neighbours lie in the 3^D cells around a particle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/vec.h"
#include "sim/scene/scene.h"

namespace curlew {

// How space is cut into cells; the same for a whole run.
struct CellShape {
  std::array<float, 3> origin{};
  std::array<float, 3> inverse_width{};
  std::array<int, 3> periodic_cells{};  // cells along a periodic axis, 0 where not periodic
  std::array<float, 3> period{};        // length of a periodic axis in m, 0 where not periodic

  bool periodic() const { return periodic_cells[0] + periodic_cells[1] + periodic_cells[2] != 0; }
  std::array<int, 3> cell_of(Vec3 position) const;
};

CellShape make_cell_shape(const Domain& domain, int dimension, double support);

class Grid {
 public:
  // Sorts nothing itself: fills `order` so that order[k] is the particle that belongs at place k. Stable.
  void build(const CellShape& shape, std::span<const Vec3> position, std::vector<std::uint32_t>& order);

  std::size_t cell_number() const { return cells_.empty() ? 0 : cells_.size() - 1; }
  std::uint32_t begin(std::size_t cell) const { return cells_[cell].begin; }
  std::uint32_t end(std::size_t cell) const { return cells_[cell + 1].begin; }
  std::array<int, 3> coordinates(std::size_t cell) const;
  std::size_t bytes() const;

  // A run of consecutive particles near a cell, and by how much a periodic image shifts them.
  struct Run {
    std::uint32_t begin, end;
    Vec3 shift;
  };

  // Where the last look-up of each row ended; rows are looked up in rising order, so the next one begins there.
  struct Hints {
    std::array<std::size_t, 18> at{};
  };

  // Calls visit(run) for each non-empty run of particles in the cells around `cell` (itself included), in a fixed
  // order.
  template <class Visit>
  void for_runs_around(const CellShape& shape, std::array<int, 3> cell, Hints& hints, Visit&& visit) const;

 private:
  struct Cell {
    std::uint64_t key;
    std::uint32_t begin;
  };
  struct Entry {
    std::uint64_t key;
    std::uint32_t particle;
  };

  std::uint64_t key(std::array<int, 3> c) const;
  void find_extent(const CellShape& shape, std::span<const Vec3> position);
  void radix_sort();
  void collect_cells();
  std::size_t seek(std::size_t& hint, std::uint64_t key) const;
  template <class Visit>
  void visit_row(std::array<int, 3> from, int to_z, Vec3 shift, std::size_t& hint, Visit&& visit) const;

  std::array<int, 3> low_{};               // smallest occupied coordinates
  std::array<std::uint64_t, 3> extent_{};  // coordinates along each axis, with a rim of one
  std::vector<Cell> cells_;                // occupied, rising key, and one end mark
  std::vector<Entry> entries_, entries_other_;
};

template <class Visit>
void Grid::visit_row(std::array<int, 3> from, int to_z, Vec3 shift, std::size_t& hint, Visit&& visit) const {
  for (int axis = 0; axis < 2; ++axis) {
    const auto offset = static_cast<std::int64_t>(from[axis]) - low_[axis] + 1;
    if (offset < 1 || offset > static_cast<std::int64_t>(extent_[axis]) - 2) return;
  }
  const int highest_z = low_[2] + static_cast<int>(extent_[2]) - 3;
  const int first_z = from[2] < low_[2] ? low_[2] : from[2], last_z = to_z > highest_z ? highest_z : to_z;
  if (first_z > last_z) return;
  const std::size_t first = seek(hint, key({from[0], from[1], first_z}));
  const std::uint64_t last_key = key({from[0], from[1], last_z});
  std::size_t last = first;
  while (cells_[last].key <= last_key) ++last;
  if (last > first) visit(Run{cells_[first].begin, cells_[last].begin, shift});
}

template <class Visit>
void Grid::for_runs_around(const CellShape& shape, std::array<int, 3> cell, Hints& hints, Visit&& visit) const {
  if (cell_number() == 0) return;
  // The periodic image of coordinate c along an axis, and the shift that takes its particles next to this cell.
  const auto image = [&](int axis, int c, float& shift) {
    const int n = shape.periodic_cells[axis];
    shift = 0;
    if (n == 0) return c;
    if (c < 0) return shift = -shape.period[axis], c + n;
    if (c >= n) return shift = shape.period[axis], c - n;
    return c;
  };
  std::size_t row = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy, ++row) {
      Vec3 shift;
      const int x = image(0, cell[0] + dx, shift.x), y = image(1, cell[1] + dy, shift.y);
      int low = cell[2] - 1, high = cell[2] + 1;
      const int n = shape.periodic_cells[2];
      if (n != 0 && (low < 0 || high >= n)) {
        const int beyond = low < 0 ? n - 1 : 0;
        Vec3 wrapped = shift;
        wrapped.z = low < 0 ? -shape.period[2] : shape.period[2];
        visit_row({x, y, beyond}, beyond, wrapped, hints.at[9 + row], visit);
        low = low < 0 ? 0 : low;
        high = high >= n ? n - 1 : high;
      }
      visit_row({x, y, low}, high, shift, hints.at[row], visit);
    }
  }
}

}  // namespace curlew
