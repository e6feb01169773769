#include "sim/turbulence/wavelet_noise.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>

#include "sim/core/error.h"
#include "sim/core/simd.h"

namespace curlew {
namespace {

using d4 = double __attribute__((vector_size(32)));
using l4 = std::int64_t __attribute__((vector_size(32)));

f4& quad(Vec3& v) { return reinterpret_cast<f4&>(v); }
f4 quad(const Vec3& v) { return reinterpret_cast<const f4&>(v); }
d4 wide(const Vec3& v) { return __builtin_convertvector(quad(v), d4); }
f4 narrow(d4 v) { return __builtin_convertvector(v, f4); }

// --- The tile ---------------------------------------------------------------------------------------------------
//
// Sums of the filters are formed without any rounding, so that neither their order nor fused multiply-adds can change a
// bit: random numbers are multiples of 2^-16, filter coefficients of 2^-28, what the filters give is rounded to 2^-17
// after each axis, and all of it is less than 2^7, as 6 times the sum of |a|, cubed, is 75: 52 bits of a double's 53,
// and 24 bits where it is stored as float.

constexpr int taps = 32, reach = taps / 2;
constexpr std::array<double, taps> analysis = [] {
  std::array<double, taps> a{};
  for (int k = 0; k < taps; ++k) {
    const double steps = wavelet_analysis[k] * 0x1p28;
    a[k] = static_cast<double>(static_cast<std::int64_t>(steps + (steps < 0 ? -0.5 : 0.5))) * 0x1p-28;
  }
  return a;
}();

constexpr double sum_of_analysis(bool absolute) {
  double sum = 0;
  for (const double a : analysis) sum += absolute && a < 0 ? -a : a;
  return sum;
}
static_assert(sum_of_analysis(false) > 1 - 2e-6 && sum_of_analysis(false) < 1 + 2e-6);
static_assert(6 * sum_of_analysis(true) * sum_of_analysis(true) * sum_of_analysis(true) < 128);

// To a multiple of 2^-17: where 1.5 * 2^35 is added, a double has no finer digits.
d4 rounded(d4 v) {
  constexpr double shift = 0x1.8p35;
  return (v + shift) - shift;
}

// Number n of the sequence of random bits with this key (splitmix64: Steele, Lea & Flood 2014).
std::uint64_t random_bits(std::uint64_t key, std::uint64_t n) {
  std::uint64_t z = key + (n + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Near enough to a normal distribution with variance 1: the sum of twelve whole numbers from 0 to 65535, less its mean,
// over 65536. A multiple of 2^-16 between -6 and 6.
float random_number(std::uint64_t key, std::uint64_t n) {
  std::int32_t sum = -12 * 65535 / 2;
  for (std::uint64_t draw = 0; draw < 3; ++draw) {
    const std::uint64_t bits = random_bits(key, 3 * n + draw);
    for (int part = 0; part < 64; part += 16) sum += static_cast<std::int32_t>(bits >> part & 0xffff);
  }
  return static_cast<float>(sum) * 0x1p-16f;
}

// f(a, b) for all pairs below (n, m), on all cores.
template <class F>
void for_pairs_of(int n, int m, F&& f) {
#pragma omp parallel for schedule(static)
  for (int pair = 0; pair < n * m; ++pair) f(pair % n, pair / n);
}

// Halves rows of n numbers along x: `rows` of them, one behind the other.
void halve_rows(const Array<Vec3>& from, int n, int rows, Array<Vec3>& to) {
  to.resize(static_cast<std::size_t>(n / 2) * static_cast<std::size_t>(rows));
  for_pairs_of(rows, 1, [&](int row, int) {
    d4 line[WaveletNoise::largest + taps];
    for (int k = 0; k < n + taps; ++k) line[k] = wide(from[row * std::ptrdiff_t{n} + ((k - reach) & (n - 1))]);
    for (int i = 0; i < n / 2; ++i) {
      d4 sum{};
      for (int k = 0; k < taps; ++k) sum += analysis[k] * line[2 * i + k];
      quad(to[row * std::ptrdiff_t{n / 2} + i]) = narrow(rounded(sum));
    }
  });
}

// Halves the number of rows (n of them, of `length` numbers, one behind the other) in each of `blocks` blocks.
void halve_blocks(const Array<Vec3>& from, int length, int n, int blocks, Array<Vec3>& to) {
  to.resize(from.size() / 2);
  constexpr int piece = 64;
  const int pieces = (length + piece - 1) / piece;
  for_pairs_of(n / 2 * pieces, blocks, [&](int place, int block) {
    const int i = place % (n / 2), begin = place / (n / 2) * piece, end = std::min(length, begin + piece);
    d4 sum[piece] = {};
    for (int k = 0; k < taps; ++k) {
      const Vec3* row = &from[(std::ptrdiff_t{n} * block + ((2 * i + k - reach) & (n - 1))) * length];
      for (int x = begin; x < end; ++x) sum[x - begin] += analysis[k] * wide(row[x]);
    }
    Vec3* row = &to[(std::ptrdiff_t{n / 2} * block + i) * length];
    for (int x = begin; x < end; ++x) quad(row[x]) = narrow(rounded(sum[x - begin]));
  });
}

}  // namespace

WaveletNoise::WaveletNoise(int size, std::uint64_t seed) : size_(size) {
  if (size < smallest || size > largest || !std::has_single_bit(static_cast<unsigned>(size))) {
    throw InputError("a tile of wavelet noise has 32, 64, 128 or 256 numbers along each axis, not " +
                     std::to_string(size));
  }
  const auto row = static_cast<std::size_t>(size + 2);
  tile_.assign(row * row * row, Vec3{});
  // The fine grid's nodes lie beside the coarse ones in one cell and between them in the next: the variance of one tile
  // changes 4.4 fold from place to place. So the paper adds the tile to itself, moved by an odd number of cells along
  // each axis (then 2.4 fold). We add another tile, as the same one would leave places half a tile apart with a
  // correlation of 1/2.
  Array<Vec3> numbers;
  for (int copy = 0; copy < 2; ++copy) {
    fill_random(random_bits(seed, static_cast<std::uint64_t>(copy)), numbers);
    add_band(numbers, copy);
  }
  fill_ghosts();
}

void WaveletNoise::fill_random(std::uint64_t key, Array<Vec3>& numbers) const {
  const std::ptrdiff_t n = size_;
  numbers.resize(static_cast<std::size_t>(n * n * n));
  for_pairs_of(size_, size_, [&](int y, int z) {
    for (std::ptrdiff_t i = (y + n * z) * n; i < (y + 1 + n * z) * n; ++i) {
      for (int tile = 0; tile < 3; ++tile)
        numbers[i][tile] = random_number(key, static_cast<std::uint64_t>(3 * i + tile));
    }
  });
}

// Adds to the tile, moved by `shift` along each axis, the numbers less what the next coarser grid can hold of them.
void WaveletNoise::add_band(const Array<Vec3>& numbers, int shift) {
  const int n = size_, h = n / 2;
  Array<Vec3> halved, quartered, coarse;
  halve_rows(numbers, n, n * n, halved);
  halve_blocks(halved, h, n, n, quartered);
  halve_blocks(quartered, h * h, n, 1, coarse);
  // Refinement: fine coefficient k is 3/4 of coarse one (k + 1) / 2, rounded down, plus 1/4 of its neighbour.
  const auto near = [&](int k) { return ((k + 1) / 2) & (h - 1); };
  const auto far = [&](int k) { return (k % 2 == 0 ? k / 2 + 1 : k / 2) & (h - 1); };
  for_pairs_of(n, n, [&](int y, int z) {
    const auto row = [&](int j, int k) { return &coarse[(j + std::ptrdiff_t{h} * k) * h]; };
    const Vec3* r[4] = {row(near(y), near(z)), row(far(y), near(z)), row(near(y), far(z)), row(far(y), far(z))};
    d4 line[largest / 2];
    for (int x = 0; x < h; ++x)
      line[x] = 0.0625 * (9.0 * wide(r[0][x]) + 3.0 * (wide(r[1][x]) + wide(r[2][x])) + wide(r[3][x]));
    for (int x = 0; x < n; ++x) {
      const auto moved = [&](int k) { return (k + shift) & (n - 1); };
      f4& sum = quad(tile_[at(moved(x), moved(y), moved(z))]);
      const d4 band = wide(numbers[x + (y + std::ptrdiff_t{n} * z) * n]) - 0.25 * (3.0 * line[near(x)] + line[far(x)]);
      sum = narrow(__builtin_convertvector(sum, d4) + band);
    }
  });
}

void WaveletNoise::fill_ghosts() {
  const auto inside = [&](int k) { return k & (size_ - 1); };
  for_pairs_of(size_ + 2, size_ + 2, [&](int j, int k) {
    const int y = j - 1, z = k - 1;
    Vec3* row = &tile_[at(0, y, z)];
    const Vec3* same = &tile_[at(0, inside(y), inside(z))];
    if (row != same) std::copy_n(same, size_, row);
    row[-1] = row[size_ - 1];
    row[size_] = row[0];
  });
}

// --- Reconstruction ---------------------------------------------------------------------------------------------

namespace {

struct Tile {
  const Vec3* corner;
  std::int64_t size, row, plane;
  Tile(const Array<Vec3>& tile, int numbers) : corner(tile.data()), size(numbers), row(numbers + 2), plane(row * row) {
    assert(!tile.empty());
  }
};

// Where a place lies: the first of the 27 nodes around it, and its way from the one in their middle, -1/2 to 1/2.
struct Place {
  const Vec3* first;
  f4 t;
};

// Where 1.5 * 2^52 is added, a double has no digits after the point, and the last ones before it are those of the
// nearest whole number in two's complement: they wrap, negative ones too, by masking. What is not finite leads to some
// node, and its t is NaN.
Place find_place(const Tile& tile, d4 x) {
  constexpr double shift = 0x1.8p52;
  const d4 shifted = x + shift;
  const l4 node = std::bit_cast<l4>(shifted) & (tile.size - 1);
  return {tile.corner + node[0] + node[1] * tile.row + node[2] * tile.plane, narrow(x - (shifted - shift))};
}

// Of all three tiles: the value and the derivative along x, side by side, and the derivatives along y and z.
struct Sums {
  f8 value_x{};
  f4 y{}, z{};

  Vec3 value() const { return {value_x[0], value_x[1], value_x[2]}; }
  Vec3 curl() const { return {y[2] - z[1], z[0] - value_x[6], value_x[5] - y[0]}; }
  Vec3 planar_curl() const { return {y[2], -value_x[6], 0}; }
};

f8 twice(f4 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3, 0, 1, 2, 3); }
f4 first(f8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }

// Of the quadratic B-splines at nodes -1, 0, 1 of an axis, at t: Cook & DeRose's w0, w1, w2, and their derivatives.
struct Splines {
  f8 value[3], slope[3];
  explicit Splines(f8 t) {
    const f8 low = t - 0.5f, high = t + 0.5f;
    value[0] = 0.5f * low * low;
    value[1] = 0.75f - t * t;
    value[2] = 0.5f * high * high;
    slope[0] = low;
    slope[1] = -2.0f * t;
    slope[2] = high;
  }
  // The values in the first four lanes, the derivatives in the others.
  f8 both(int k) const { return __builtin_shufflevector(value[k], slope[k], 0, 1, 2, 3, 12, 13, 14, 15); }
};

// Over the 27 nodes, rows first: 27 loads and 54 multiply-adds.
Sums sum_nodes(const Tile& tile, const Place& place) {
  const f4 t = place.t;
  const Splines x(__builtin_shufflevector(t, t, 0, 0, 0, 0, 0, 0, 0, 0));
  const Splines y(__builtin_shufflevector(t, t, 1, 1, 1, 1, 1, 1, 1, 1));
  const Splines z(__builtin_shufflevector(t, t, 2, 2, 2, 2, 2, 2, 2, 2));
  const f8 x0 = x.both(0), x1 = x.both(1), x2 = x.both(2);
  Sums sums;
  for (int c = 0; c < 3; ++c) {
    f8 value_x{}, slope_y{};
    for (int b = 0; b < 3; ++b) {
      const Vec3* node = place.first + b * tile.row + c * tile.plane;
      const f8 line = x0 * twice(quad(node[0])) + x1 * twice(quad(node[1])) + x2 * twice(quad(node[2]));
      value_x += y.value[b] * line;
      slope_y += y.slope[b] * line;
    }
    sums.value_x += z.value[c] * value_x;
    sums.y += first(z.value[c] * slope_y);
    sums.z += first(z.slope[c] * value_x);
  }
  return sums;
}

// Over the octaves, each 2^(-5/6) of the coarser one. The next one's place is found before the sums of this one, which
// hides the wait for its address: 45 instead of 58 ns for three octaves.
Sums sum_octaves(const Tile& tile, Vec3d p, std::span<const Vec3d> offset) {
  constexpr float fall = 0.561231024f;
  Sums sums;
  if (offset.empty()) return sums;
  d4 scaled{p.x, p.y, p.z, 0};
  float amplitude = 1;
  const auto moved = [&](std::size_t o) { return scaled + d4{offset[o].x, offset[o].y, offset[o].z, 0}; };
  Place next = find_place(tile, moved(0));
  for (std::size_t o = 0; o < offset.size(); ++o) {
    const Place place = next;
    scaled += scaled;
    if (o + 1 < offset.size()) next = find_place(tile, moved(o + 1));
    const Sums octave = sum_nodes(tile, place);
    sums.value_x += amplitude * octave.value_x;
    sums.y += amplitude * octave.y;
    sums.z += amplitude * octave.z;
    amplitude *= fall;
  }
  return sums;
}

constexpr Vec3d one_octave[1]{};

}  // namespace

Vec3 WaveletNoise::value(Vec3d p) const { return sum_octaves({tile_, size_}, p, one_octave).value(); }

Vec3 WaveletNoise::curl(Vec3d p) const { return sum_octaves({tile_, size_}, p, one_octave).curl(); }

Vec3 WaveletNoise::turbulence(Vec3d p, std::span<const Vec3d> offset) const {
  return sum_octaves({tile_, size_}, p, offset).curl();
}

Vec3 WaveletNoise::planar_turbulence(Vec3d p, std::span<const Vec3d> offset) const {
  return sum_octaves({tile_, size_}, p, offset).planar_curl();
}

}  // namespace curlew
