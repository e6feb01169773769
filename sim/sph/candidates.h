// The particles of the cells around one cell, copied side by side so that eight are tested at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/simd.h"
#include "sim/sph/grid.h"

namespace curlew {

struct Candidates {
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> number;
  std::size_t size = 0;

  // Fills in the particles of `grid` around `cell`, periodic images moved next to it. Eight places beyond `size` hold
  // a point that is never near.
  void collect(const CellShape& shape, const Grid& grid, std::array<int, 3> cell, std::span<const Vec3> position,
               Grid::Hints& hints) {
    size = 0;
    reserve(8);
    grid.for_runs_around(shape, cell, hints, [&](const Grid::Run& run) {
      reserve(size + (run.end - run.begin) + 8);
      for (std::uint32_t j = run.begin; j < run.end; ++j, ++size) {
        x[size] = position[j].x + run.shift.x;
        y[size] = position[j].y + run.shift.y;
        z[size] = position[j].z + run.shift.z;
        number[size] = j;
      }
    });
    for (std::size_t k = size; k < size + 8; ++k) {
      x[k] = 1e30f;
      y[k] = z[k] = 0;
      number[k] = size > 0 ? number[0] : 0;
    }
  }

  // Eight candidates from place k on, seen from `here`.
  struct Offsets {
    f8 x, y, z, r2;
  };
  Offsets offsets(Vec3 here, std::size_t k) const {
    Offsets o{here.x - load(&x[k]), here.y - load(&y[k]), here.z - load(&z[k]), {}};
    o.r2 = o.x * o.x + o.y * o.y + o.z * o.z;
    return o;
  }

 private:
  void reserve(std::size_t n) {
    if (n <= x.size()) return;
    for (auto* values : {&x, &y, &z}) values->resize(2 * n);
    number.resize(2 * n);
  }
};

}  // namespace curlew
