#include "sim/sph/neighbours.h"

#include <atomic>
#include <numeric>

#include "sim/core/parallel.h"
#include "sim/sph/candidates.h"

namespace curlew {
namespace {

// Appends the neighbours of particle i to `to` (room for all candidates and eight more) and returns their number.
std::uint32_t choose(const Candidates& near, Vec3 here, std::uint32_t i, float support2, std::uint32_t* to) {
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < near.size; k += 8) {
    i8 number;
    __builtin_memcpy(&number, &near.number[k], sizeof number);
    const i8 chosen = (near.offsets(here, k).r2 < support2) & (number != static_cast<std::int32_t>(i));
    count += static_cast<std::uint32_t>(compress(&near.number[k], chosen, to + count));
  }
  return count;
}

}  // namespace

void NeighbourLists::build(const CellShape& shape, const Grid& grid, std::span<const Vec3> position, double support) {
  const std::size_t n = position.size();
  const auto support2 = static_cast<float>(support * support);
  count_.resize(n);
  first_group_.resize(n);
  // Threads append finished chunks of cells to one array wherever there is room next: the place differs from run to
  // run, what a particle finds there does not. The array has the size that the last step needed; if this one needs
  // more, it is built again with more room, which happens a few times a run.
  std::atomic<std::size_t> used;
  do {
    used = 0;
    const std::size_t room = entries_.size() / 8;
#pragma omp parallel
    {
      Candidates near;
      Grid::Hints hints;
      std::vector<std::uint32_t> chunk;
#pragma omp for schedule(dynamic, 1)
      for (std::size_t first = 0; first < grid.cell_number(); first += 32) {
        const std::size_t last = std::min(first + 32, grid.cell_number());
        std::size_t size = 0;
        for (std::size_t cell = first; cell < last; ++cell) {
          near.collect(shape, grid, grid.coordinates(cell), position, hints);
          for (std::uint32_t i = grid.begin(cell); i < grid.end(cell); ++i) {
            if (chunk.size() < size + near.size + 16) chunk.resize(2 * (size + near.size + 16));
            count_[i] = choose(near, position[i], i, support2, &chunk[size]);
            first_group_[i] = static_cast<std::uint32_t>(size / 8);
            for (size += count_[i]; size % 8 != 0; ++size) chunk[size] = i;
          }
        }
        const std::size_t at = used.fetch_add(size / 8);
        if (at + size / 8 > room) continue;
        std::copy_n(chunk.begin(), size, entries_.begin() + static_cast<std::ptrdiff_t>(at * 8));
        for (std::uint32_t i = grid.begin(first); i < grid.end(last - 1); ++i)
          first_group_[i] += static_cast<std::uint32_t>(at);
      }
    }
    if (used <= room) break;
    entries_ = {};
    entries_.resize((used + used / 16) * 8);
  } while (true);
  pairs_ = std::accumulate(count_.begin(), count_.end(), std::uint64_t{0});
}

std::size_t NeighbourLists::bytes() const {
  return entries_.capacity() * sizeof(std::uint32_t) + first_group_.capacity() * 4 + count_.capacity() * 4;
}

}  // namespace curlew
