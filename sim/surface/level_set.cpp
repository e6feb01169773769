// References:
//   Mueller, Charypar & Gross 2003, "Particle-based fluid simulation for interactive applications": the kernel.
//   Yu & Turk 2013, "Reconstructing surfaces of particle-based fluids using anisotropic kernels": the sum.
#include "sim/surface/level_set.h"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"
#include "sim/core/simd.h"

namespace curlew {
namespace {

// An octant of a brick counts as full with this share of the particles that fit: fluctuations of disordered water stay
// above it, and holes of more than a particle or two do not.
constexpr double full_share = 0.7;

// The octants of a neighbour brick that touch the brick in the middle: bit 4 x + 2 y + z.
std::uint8_t touching_octants(int dx, int dy, int dz) {
  const std::array<int, 3> d{dx, dy, dz};
  unsigned octants = 0;
  for (unsigned o = 0; o < 8; ++o) {
    bool touches = true;
    for (int axis = 0; axis < 3; ++axis) {
      const bool high = (o >> (2 - axis) & 1u) != 0;
      const int step = d[static_cast<std::size_t>(axis)];
      if ((step == 1 && high) || (step == -1 && !high)) touches = false;
    }
    if (touches) octants |= 1u << o;
  }
  return static_cast<std::uint8_t>(octants);
}

// Calls f(dx, dy, dz, number) for the 27 places around a brick.
template <class F>
void for_places_around(F&& f) {
  std::size_t number = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) f(dx, dy, dz, number++);
    }
  }
}

}  // namespace

SourceShape round_shape(double radius) {
  const auto r = static_cast<float>(radius);
  const float m = 1 / (r * r);
  return {{m, m, m}, {}, {r, r, r}};
}

struct LevelSet::Occupied {
  std::array<int, 3> at;
  std::uint32_t touched = 0;  // bit a place around: the sources reach points there
  std::uint8_t full = 0;      // bit an octant
};

// In cells, from the brick's first point.
struct LevelSet::Local {
  float x, y, z, w;
  float xx, yy, zz, yz, zx, xy;
  float reach_x, reach_y;
};

void LevelSet::lay_out(const Domain& domain, double cell) {
  low_ = domain.min;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double length = domain.max[axis] - domain.min[axis];
    cells_[a] = std::max(1, static_cast<int>(std::min(std::ceil(length / cell - 1e-6), 1e8)));
    cell_[axis] = length / cells_[a];
    cut_low_[a] = is_cut_off(domain, axis, 0);
    cut_high_[a] = is_cut_off(domain, axis, 1);
    brick_shape_.origin[a] = static_cast<float>(domain.min[axis] - 0.5 * cell_[axis]);
    brick_shape_.inverse_width[a] = static_cast<float>(1 / (side * cell_[axis]));
  }
}

// The sources, and beside them their images behind walls and periodic faces as far as they reach; sorted by brick.
void LevelSet::collect_sources(const SurfaceSources& sources, const Domain& domain) {
  reach_ = {};
  for (const SourceShape& shape : sources.shape) {
    for (int axis = 0; axis < 3; ++axis) reach_[axis] = std::max(reach_[axis], shape.reach[axis]);
  }
  collect_images(sources.position, domain, reach_, unsorted_, unsorted_origin_);
  grid_.build(brick_shape_, unsorted_, order_);
  position_.resize(order_.size());
  origin_.resize(order_.size());
  parallel_for(order_.size(), [&](std::size_t k) {
    position_[k] = unsorted_[order_[k]];
    origin_[k] = unsorted_origin_[order_[k]];
  });
}

void LevelSet::find_bricks(const SurfaceSources& sources) {
  const double spacing = sources.spacing;
  const double in_octant = cell_.x * cell_.y * cell_.z * points / 8 / (spacing * spacing * spacing);
  const bool by_octant = in_octant >= 7;
  const double wanted = full_share * in_octant * (by_octant ? 1 : 8);
  std::vector<Occupied> occupied(grid_.cell_number());
#pragma omp parallel for schedule(dynamic, 32)
  for (std::size_t c = 0; c < occupied.size(); ++c) {
    Occupied& o = occupied[c];
    o.at = grid_.coordinates(c);
    std::array<float, 3> least, most, middle, first;
    std::array<unsigned, 8> number{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      least[a] = INFINITY;
      most[a] = -INFINITY;
      first[a] = static_cast<float>(low_[axis] + (side * o.at[a] - 0.5) * cell_[axis]);
      middle[a] = first[a] + static_cast<float>(0.5 * side * cell_[axis]);
    }
    for (std::uint32_t i = grid_.begin(c); i < grid_.end(c); ++i) {
      const Vec3 p = position_[i];
      unsigned octant = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        least[a] = std::min(least[a], p[axis]);
        most[a] = std::max(most[a], p[axis]);
        octant = 2 * octant + (p[axis] >= middle[a] ? 1 : 0);
      }
      if (sources.kind.empty() || sources.kind[origin_[i].number()] == 0) ++number[octant];
    }
    unsigned all = 0;
    for (unsigned k = 0; k < 8; ++k) {
      all += number[k];
      if (number[k] >= wanted) o.full = static_cast<std::uint8_t>(o.full | 1u << k);
    }
    if (!by_octant) o.full = all >= wanted ? 0xff : 0;
    const auto touches = [&](int axis, int step) {
      const auto a = static_cast<std::size_t>(axis);
      const auto cell = static_cast<float>(cell_[axis]);
      if (step < 0) return least[a] - reach_[axis] <= first[a] - cell;
      if (step > 0) return most[a] + reach_[axis] >= first[a] + static_cast<float>(side) * cell;
      return true;
    };
    for_places_around([&](int dx, int dy, int dz, std::size_t k) {
      if (touches(0, dx) && touches(1, dy) && touches(2, dz)) o.touched |= 1u << k;
    });
  }
  link_bricks(occupied);
}

// The bricks that any source reaches, but for those wholly behind a face of the domain; in the order of their keys.
void LevelSet::link_bricks(const std::vector<Occupied>& occupied) {
  keys_.clear();
  bricks_.clear();
  if (occupied.empty()) return;
  // A rim of two, so that neighbours of bricks beside occupied ones have keys of their own.
  std::array<int, 3> first{INT32_MAX, INT32_MAX, INT32_MAX}, last{INT32_MIN, INT32_MIN, INT32_MIN};
  for (const Occupied& o : occupied) {
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = std::min(first[a], o.at[a] - 2);
      last[a] = std::max(last[a], o.at[a] + 2);
    }
  }
  const std::uint64_t along_z = static_cast<std::uint64_t>(last[2] - first[2] + 1),
                      along_y = static_cast<std::uint64_t>(last[1] - first[1] + 1) * along_z;
  const auto key = [&](std::array<int, 3> at) {
    const auto from = [&](std::size_t a) { return static_cast<std::uint64_t>(at[a] - first[a]); };
    return from(0) * along_y + from(1) * along_z + from(2);
  };
  const auto within = [&](std::array<int, 3> at) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (cut_low_[a] && at[a] < 0) return false;
      if (cut_high_[a] && side * at[a] > cells_[a] + 1) return false;
    }
    return true;
  };
  for (const Occupied& o : occupied) {
    for_places_around([&](int dx, int dy, int dz, std::size_t k) {
      const std::array<int, 3> at{o.at[0] + dx, o.at[1] + dy, o.at[2] + dz};
      if ((o.touched >> k & 1u) != 0 && within(at)) keys_.push_back(key(at));
    });
  }
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
  bricks_.resize(keys_.size());

  std::vector<std::uint8_t> full(keys_.size());
  for (std::size_t b = 0, next = 0; next < occupied.size(); ++next) {  // both rise
    const std::uint64_t k = key(occupied[next].at);
    while (b < keys_.size() && keys_[b] < k) ++b;
    if (b < keys_.size() && keys_[b] == k) full[b] = occupied[next].full;
  }
  std::array<std::uint8_t, 27> touching;
  for_places_around([&](int dx, int dy, int dz, std::size_t k) { touching[k] = touching_octants(dx, dy, dz); });
  parallel_blocks(bricks_.size(), [&](std::size_t begin, std::size_t end) {
    // Where the rows of three before, beside and after a brick begin; they move on with it.
    std::array<std::size_t, 9> rows;
    const auto row_key = [&](std::size_t b, std::size_t row) {
      return keys_[b] - along_y - along_z - 1 + row / 3 * along_y + row % 3 * along_z;
    };
    for (std::size_t row = 0; row < 9; ++row) {
      rows[row] =
          static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), row_key(begin, row)) - keys_.begin());
    }
    for (std::size_t b = begin; b < end; ++b) {
      Brick& brick = bricks_[b];
      const std::uint64_t k = keys_[b];
      brick.at = {first[0] + static_cast<int>(k / along_y), first[1] + static_cast<int>(k % along_y / along_z),
                  first[2] + static_cast<int>(k % along_z)};
      brick.full = true;
      for (std::size_t a = 0; a < 3; ++a) {
        if ((cut_low_[a] && brick.at[a] == 0) || (cut_high_[a] && side * (brick.at[a] + 1) > cells_[a]))
          brick.full = false;
      }
      for (std::size_t row = 0; row < 9; ++row) {
        const std::uint64_t from = row_key(b, row);
        std::size_t& at = rows[row];
        while (at < keys_.size() && keys_[at] < from) ++at;
        std::size_t found = at;
        for (std::size_t z = 0; z < 3; ++z) {
          const std::size_t n = 3 * row + z;
          const bool there = found < keys_.size() && keys_[found] == from + z;
          brick.near[n] = there ? static_cast<std::int32_t>(found) : -1;
          if (!there || (full[found] & touching[n]) != touching[n]) brick.full = false;
          if (there) ++found;
        }
      }
    }
  });
}

namespace {

// Adds a source to all points of a brick; rows along z are one register.
template <bool round, class Local>
void add_source(const Local& s, f8 (&sum)[LevelSet::side * LevelSet::side]) {
  constexpr int last = LevelSet::side - 1;
  const f8 dz = f8{0, 1, 2, 3, 4, 5, 6, 7} - s.z;
  const f8 along = 1.0f - s.zz * dz * dz;
  const float weight = s.w;
  const int x0 = std::max(0, static_cast<int>(std::ceil(s.x - s.reach_x))),
            x1 = std::min(last, static_cast<int>(std::floor(s.x + s.reach_x)));
  const int y0 = std::max(0, static_cast<int>(std::ceil(s.y - s.reach_y))),
            y1 = std::min(last, static_cast<int>(std::floor(s.y + s.reach_y)));
  for (int x = x0; x <= x1; ++x) {
    const float dx = static_cast<float>(x) - s.x, xx = s.xx * dx * dx;
    for (int y = y0; y <= y1; ++y) {
      const float dy = static_cast<float>(y) - s.y;
      f8 t;
      if constexpr (round) {
        const float across = xx + s.yy * dy * dy;
        t = max(along - across, f8{});
      } else {
        const float across = xx + s.yy * dy * dy + 2 * s.xy * dx * dy, tilt = 2 * (s.yz * dy + s.zx * dx);
        if (across - tilt * tilt / (4 * s.zz) >= 1) continue;
        t = max(along - across - tilt * dz, f8{});
      }
      sum[LevelSet::side * x + y] += weight * t * t * t;
    }
  }
}

}  // namespace

std::span<const std::uint32_t> LevelSet::find_sources(const Brick& brick, Searcher& searcher) const {
  auto& [near, hints, found] = searcher;
  const Vec3 first = place(brick, 0, 0, 0), last = place(brick, side - 1, side - 1, side - 1);
  near.collect(brick_shape_, grid_, brick.at, position_, hints);
  if (found.size() < near.size + 16) found.resize(near.size + 16);
  std::size_t number = 0;
  for (std::size_t k = 0; k < near.size; k += 8) {
    const f8 x = load(&near.x[k]), y = load(&near.y[k]), z = load(&near.z[k]);
    const f8 dx = max(max(first.x - x, x - last.x), f8{}) * (1 / reach_.x),
             dy = max(max(first.y - y, y - last.y), f8{}) * (1 / reach_.y),
             dz = max(max(first.z - z, z - last.z), f8{}) * (1 / reach_.z);
    number += static_cast<std::size_t>(compress(&near.number[k], dx * dx + dy * dy + dz * dz < 1.0f, &found[number]));
  }
  return {found.data(), number};
}

void LevelSet::sum_sources(const SurfaceSources& sources) {
  values_.resize(bricks_.size() * points);
  inside_.resize(bricks_.size());
  const bool round = sources.shape.size() == 1 || !sources.kind.empty();
  const std::array<float, 3> per_cell{static_cast<float>(1 / cell_.x), static_cast<float>(1 / cell_.y),
                                      static_cast<float>(1 / cell_.z)};
  const auto local = [&](std::uint32_t j, Vec3 first) {
    const ImageOrigin origin = origin_[j];
    const std::size_t own = origin.number();
    const SourceShape& shape = sources.shape[!sources.kind.empty() ? sources.kind[own] : round ? 0 : own];
    const Vec3 p = position_[j] - first;
    const auto cx = 1 / per_cell[0], cy = 1 / per_cell[1], cz = 1 / per_cell[2];
    const auto sign = [&](int a, int b) {  // of a mixed term, under reflection
      return origin.is_mirrored(a) != origin.is_mirrored(b) ? -1.0f : 1.0f;
    };
    return Local{p.x * per_cell[0],
                 p.y * per_cell[1],
                 p.z * per_cell[2],
                 position_[j].w,
                 shape.diagonal.x * cx * cx,
                 shape.diagonal.y * cy * cy,
                 shape.diagonal.z * cz * cz,
                 sign(1, 2) * shape.mixed.x * cy * cz,
                 sign(2, 0) * shape.mixed.y * cz * cx,
                 sign(0, 1) * shape.mixed.z * cx * cy,
                 shape.reach.x * per_cell[0],
                 shape.reach.y * per_cell[1]};
  };
#pragma omp parallel
  {
    Searcher searcher;
#pragma omp for schedule(dynamic, 4)
    for (std::size_t b = 0; b < bricks_.size(); ++b) {
      const Brick& brick = bricks_[b];
      float* values = &values_[b * points];
      if (brick.full) {
        std::fill_n(values, points, 1 - iso_);
        inside_[b].fill(~std::uint64_t{0});
        continue;
      }
      const Vec3 first = place(brick, 0, 0, 0);
      f8 sum[side * side];
      std::fill(std::begin(sum), std::end(sum), splat(-iso_));
      for (const std::uint32_t j : find_sources(brick, searcher)) {
        if (round)
          add_source<true>(local(j, first), sum);
        else
          add_source<false>(local(j, first), sum);
      }
      __builtin_memcpy(values, sum, sizeof sum);
      cut_off(b);
      for (int x = 0; x < side; ++x) {
        std::uint64_t word = 0;
        for (int y = 0; y < side; ++y) word |= std::uint64_t{lanes(load(&values[64 * x + 8 * y]) > 0.0f)} << (8 * y);
        inside_[b][static_cast<std::size_t>(x)] = word;
      }
    }
  }
}

// phi <- min(phi, distance from the face, one half at one cell): linear through the face, so that the surface lies in
// it exactly.
void LevelSet::cut_off(std::size_t b) {
  const Brick& brick = bricks_[b];
  float* values = &values_[b * points];
  constexpr std::array<int, 3> stride{side * side, side, 1};
  for (std::size_t a = 0; a < 3; ++a) {
    const int from_low = side * brick.at[a], from_high = cells_[a] + 1 - from_low;
    for (int p = 0; p < side; ++p) {
      float bound = INFINITY;
      if (cut_low_[a]) bound = std::min(bound, 0.5f * (static_cast<float>(from_low + p) - 0.5f));
      if (cut_high_[a]) bound = std::min(bound, 0.5f * (static_cast<float>(from_high - p) - 0.5f));
      if (bound >= 1) continue;
      const int u = stride[(a + 1) % 3], v = stride[(a + 2) % 3];
      for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
          float& value = values[p * stride[a] + i * u + j * v];
          value = std::min(value, bound);
        }
      }
    }
  }
}

void LevelSet::build(const SurfaceSources& sources, const Domain& domain, double cell, double iso) {
  iso_ = static_cast<float>(iso);
  lay_out(domain, cell);
  collect_sources(sources, domain);
  find_bricks(sources);
  sum_sources(sources);
}

std::size_t LevelSet::bytes() const {
  return unsorted_.capacity() * 2 * sizeof(Vec3) + unsorted_origin_.capacity() * 2 * sizeof(ImageOrigin) +
         order_.capacity() * sizeof(std::uint32_t) + grid_.bytes() +
         bricks_.capacity() * (sizeof(Brick) + sizeof(Bits) + sizeof(std::uint64_t)) +
         values_.capacity() * sizeof(float);
}

}  // namespace curlew
