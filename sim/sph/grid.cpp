#include "sim/sph/grid.h"

#include <algorithm>
#include <bit>

#include "sim/core/parallel.h"

namespace curlew {
namespace {

// Coordinates reach this far from the origin; what lies beyond (or is not a number) is counted to the rim cell, which
// keeps neighbours together: |a - b| < 1 holds for the clamped coordinates too.
constexpr float farthest_cell = 500000;

constexpr int radix_bits = 11;
constexpr std::size_t radix = std::size_t{1} << radix_bits;

}  // namespace

std::array<int, 3> CellShape::cell_of(Vec3 position) const {
  std::array<int, 3> cell{};
  for (int axis = 0; axis < 3; ++axis) {
    const float scaled = std::floor((position[axis] - origin[axis]) * inverse_width[axis]);
    const int n = periodic_cells[axis];
    const float low = n != 0 ? 0.0f : -farthest_cell, high = n != 0 ? static_cast<float>(n - 1) : farthest_cell;
    cell[axis] = static_cast<int>(scaled > low ? (scaled < high ? scaled : high) : low);
  }
  return cell;
}

CellShape make_cell_shape(const Domain& domain, int dimension, double support) {
  CellShape shape;
  // A little wider than the support, so that round-off in a coordinate never separates two neighbours.
  const double width = support * 1.00001;
  for (int axis = 0; axis < 3; ++axis) {
    shape.origin[axis] = static_cast<float>(domain.min[axis]);
    shape.inverse_width[axis] = static_cast<float>(1 / width);
    if (axis >= dimension || !domain.periodic[axis]) continue;
    const double length = domain.max[axis] - domain.min[axis];
    const int cells = std::max(1, static_cast<int>(length / width));
    shape.periodic_cells[axis] = cells;
    shape.period[axis] = static_cast<float>(length);
    shape.inverse_width[axis] = static_cast<float>(cells / length);
  }
  return shape;
}

std::uint64_t Grid::key(std::array<int, 3> c) const {
  const auto offset = [&](int axis) { return static_cast<std::uint64_t>(c[axis] - low_[axis] + 1); };
  return (offset(0) * extent_[1] + offset(1)) * extent_[2] + offset(2);
}

std::array<int, 3> Grid::coordinates(std::size_t cell) const {
  const std::uint64_t k = cells_[cell].key;
  const auto place = [&](int axis, std::uint64_t offset) { return low_[axis] + static_cast<int>(offset) - 1; };
  return {place(0, k / (extent_[1] * extent_[2])), place(1, k / extent_[2] % extent_[1]), place(2, k % extent_[2])};
}

void Grid::find_extent(const CellShape& shape, std::span<const Vec3> position) {
  struct Bounds {
    std::array<int, 3> low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
    void operator+=(const Bounds& other) {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], other.low[axis]);
        high[axis] = std::max(high[axis], other.high[axis]);
      }
    }
  };
  const auto bounds = ordered_sum<Bounds>(position.size(), [&](std::size_t begin, std::size_t end) {
    Bounds part;
    for (std::size_t i = begin; i < end; ++i) {
      const auto cell = shape.cell_of(position[i]);
      part += Bounds{cell, cell};
    }
    return part;
  });
  low_ = bounds.low;
  for (int axis = 0; axis < 3; ++axis) extent_[axis] = static_cast<std::uint64_t>(bounds.high[axis] - low_[axis] + 3);
}

// Least significant digit first; each pass is stable, so equal keys keep the order they came in.
void Grid::radix_sort() {
  const std::size_t n = entries_.size();
  const int bits = static_cast<int>(std::bit_width(extent_[0] * extent_[1] * extent_[2]));
  const std::size_t parts = std::min<std::size_t>(static_cast<std::size_t>(omp_get_max_threads()), 1 + n / 4096);
  const auto part_begin = [&](std::size_t p) { return n * p / parts; };
  std::vector<std::uint32_t> offsets(parts * radix);
  entries_other_.resize(n);
  for (int shift = 0; shift < bits; shift += radix_bits) {
    const auto digit = [&](const Entry& e) { return static_cast<std::size_t>(e.key >> shift) & (radix - 1); };
    const auto each_part = [&](auto&& f) {
#pragma omp parallel for schedule(static, 1)
      for (std::size_t p = 0; p < parts; ++p) f(p, &offsets[p * radix]);
    };
    each_part([&](std::size_t p, std::uint32_t* count) {
      std::fill_n(count, radix, 0u);
      for (std::size_t k = part_begin(p); k < part_begin(p + 1); ++k) ++count[digit(entries_[k])];
    });
    std::uint32_t total = 0;
    for (std::size_t d = 0; d < radix; ++d) {
      for (std::size_t p = 0; p < parts; ++p) {
        const std::uint32_t count = offsets[p * radix + d];
        offsets[p * radix + d] = total;
        total += count;
      }
    }
    each_part([&](std::size_t p, std::uint32_t* at) {
      for (std::size_t k = part_begin(p); k < part_begin(p + 1); ++k) {
        entries_other_[at[digit(entries_[k])]++] = entries_[k];
      }
    });
    entries_.swap(entries_other_);
  }
}

void Grid::collect_cells() {
  const std::size_t n = entries_.size();
  const auto starts_cell = [&](std::size_t k) { return k == 0 || entries_[k].key != entries_[k - 1].key; };
  std::vector<std::uint32_t> first(block_number(n) + 1);
  parallel_blocks(n, [&](std::size_t begin, std::size_t end) {
    std::uint32_t count = 0;
    for (std::size_t k = begin; k < end; ++k) count += starts_cell(k) ? 1 : 0;
    first[begin / block_size + 1] = count;
  });
  for (std::size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
  cells_.resize(first.back() + 1);
  parallel_blocks(n, [&](std::size_t begin, std::size_t end) {
    std::uint32_t at = first[begin / block_size];
    for (std::size_t k = begin; k < end; ++k) {
      if (starts_cell(k)) cells_[at++] = {entries_[k].key, static_cast<std::uint32_t>(k)};
    }
  });
  cells_.back() = {UINT64_MAX, static_cast<std::uint32_t>(n)};
}

void Grid::build(const CellShape& shape, std::span<const Vec3> position, std::vector<std::uint32_t>& order) {
  const std::size_t n = position.size();
  entries_.resize(n);
  order.resize(n);
  if (n == 0) return cells_.clear();
  find_extent(shape, position);
  parallel_for(n, [&](std::size_t i) {
    entries_[i] = {key(shape.cell_of(position[i])), static_cast<std::uint32_t>(i)};
  });
  radix_sort();
  collect_cells();
  parallel_for(n, [&](std::size_t k) { order[k] = entries_[k].particle; });
}

// The first cell whose key is not below `key`. Successive calls mostly ask for the next few cells.
std::size_t Grid::seek(std::size_t& hint, std::uint64_t key) const {
  std::size_t at = std::min(hint, cells_.size() - 1);
  if (at > 0 && cells_[at - 1].key >= key) at = 0;
  for (int steps = 0; cells_[at].key < key; ++steps, ++at) {
    if (steps < 8) continue;
    const auto below = [](const Cell& cell, std::uint64_t k) { return cell.key < k; };
    at = static_cast<std::size_t>(
        std::lower_bound(cells_.begin() + static_cast<std::ptrdiff_t>(at), cells_.end(), key, below) - cells_.begin());
    break;
  }
  return hint = at;
}

std::size_t Grid::bytes() const {
  return cells_.capacity() * sizeof(Cell) + (entries_.capacity() + entries_other_.capacity()) * sizeof(Entry);
}

}  // namespace curlew
