// Eight neighbours at a time, in the compiler's own vector types (gcc and clang), so that one source serves any
// instruction set. Only four operations have no such spelling and name AVX2: reciprocal square root, rounding, mask
// and compress; elsewhere they are plain loops.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "sim/core/vec.h"
#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace curlew {

using f4 = float __attribute__((vector_size(16)));
using f8 = float __attribute__((vector_size(32)));
using i8 = std::int32_t __attribute__((vector_size(32)));

inline f8 splat(float v) { return f8{} + v; }
inline i8 splat(std::int32_t v) { return i8{} + v; }
inline f8 max(f8 a, f8 b) { return a > b ? a : b; }
inline f8 min(f8 a, f8 b) { return a < b ? a : b; }

inline float sum(f8 v) {
  const f4 s = __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  return (s[0] + s[2]) + (s[1] + s[3]);
}

// 1 / sqrt(v) to about 1e-7 relative: the estimate, improved by one Newton step.
inline f8 inverse_sqrt(f8 v) {
#if defined(__AVX2__)
  const f8 y = (f8)_mm256_rsqrt_ps((__m256)v);
  return y * (1.5f - 0.5f * v * y * y);
#else
  f8 y;
  for (int lane = 0; lane < 8; ++lane) y[lane] = 1.0f / std::sqrt(v[lane]);
  return y;
#endif
}

// ln v for positive normal v, to about 1e-7 of 1 + |ln v|: v = 2^n m with m in [sqrt(1/2), sqrt(2)),
// ln m = 2 artanh((m - 1)/(m + 1)).
inline f8 natural_log(f8 v) {
  constexpr std::int32_t sqrt_half = 0x3f3504f3;
  const i8 shifted = std::bit_cast<i8>(v) - sqrt_half;
  const i8 exponent = shifted >> 23;
  const f8 m = std::bit_cast<f8>((shifted & 0x007fffff) + sqrt_half);
  const f8 t = (m - 1.0f) / (m + 1.0f), t2 = t * t;
  const f8 series = 1.0f + t2 * (1.0f / 3 + t2 * (1.0f / 5 + t2 * (1.0f / 7 + t2 * (1.0f / 9))));
  return 0.693147181f * __builtin_convertvector(exponent, f8) + 2.0f * t * series;
}

// Nearest whole numbers, ties to even.
inline f8 nearest(f8 v) {
#if defined(__AVX2__)
  return (f8)_mm256_round_ps((__m256)v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
#else
  f8 y;
  for (int lane = 0; lane < 8; ++lane) y[lane] = std::nearbyint(v[lane]);
  return y;
#endif
}

// e^v for v from -80 to 80, to about 2e-7 relative: e^v = 2^n e^r with |r| <= ln(2) / 2.
inline f8 exponential(f8 v) {
  const f8 n = nearest(v * 1.44269504f);
  const f8 r = (v - n * 0.693359375f) + n * 2.12194440e-4f;  // ln 2 in two parts
  const f8 series =
      1.0f + r * (1.0f + r * (1.0f / 2 + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
  const i8 exponent = __builtin_convertvector(n, i8) + 127;
  return series * std::bit_cast<f8>(exponent << 23);
}

// Eight vectors, one component a register.
struct Vec8 {
  f8 x, y, z, w;
};

// Loads the vectors with numbers j[0..7]: eight 16-byte loads and a transpose. Measured (README, "Where the time
// goes"): a third of the time of hardware gathers from three arrays.
inline Vec8 gather(const Vec3* from, const std::uint32_t* j) {
  const auto row = [&](int k) { return *reinterpret_cast<const f4*>(from + j[k]); };
  const auto pair = [](f4 a, f4 b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7); };
  const f8 a = pair(row(0), row(4)), b = pair(row(1), row(5)), c = pair(row(2), row(6)), d = pair(row(3), row(7));
  const f8 ab_xy = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const f8 ab_zw = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const f8 cd_xy = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const f8 cd_zw = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  return {__builtin_shufflevector(ab_xy, cd_xy, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(ab_xy, cd_xy, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(ab_zw, cd_zw, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(ab_zw, cd_zw, 2, 3, 10, 11, 6, 7, 14, 15)};
}

inline f8 gather(const float* from, const std::uint32_t* j) {
  return f8{from[j[0]], from[j[1]], from[j[2]], from[j[3]], from[j[4]], from[j[5]], from[j[6]], from[j[7]]};
}

inline f8 load(const float* from) {
  f8 v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

// A bit for each lane of `chosen` that is set (all ones).
inline std::uint8_t lanes(i8 chosen) {
#if defined(__AVX2__)
  return static_cast<std::uint8_t>(_mm256_movemask_ps((__m256)chosen));
#else
  unsigned bits = 0;
  for (unsigned lane = 0; lane < 8; ++lane) bits |= chosen[lane] != 0 ? 1u << lane : 0u;
  return static_cast<std::uint8_t>(bits);
#endif
}

#if defined(__AVX2__)
// compress_order[mask] lists the lanes that are set in mask, one byte each, lowest first.
struct CompressOrder {
  std::uint64_t order[256]{};
  constexpr CompressOrder() {
    for (unsigned mask = 0; mask < 256; ++mask) {
      int at = 0;
      for (unsigned lane = 0; lane < 8; ++lane) {
        if (mask & (1u << lane)) order[mask] |= std::uint64_t{lane} << (8 * at++);
      }
    }
  }
};
inline constexpr CompressOrder compress_order;
#endif

// Writes those of numbers[0..7] whose lane of `chosen` is set (all ones) to `to`, and returns how many. May write up
// to eight numbers, whatever it returns.
inline int compress(const std::uint32_t* numbers, i8 chosen, std::uint32_t* to) {
#if defined(__AVX2__)
  const auto mask = static_cast<unsigned>(_mm256_movemask_ps((__m256)chosen));
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&compress_order.order[mask]));
  const __m256i values = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers));
  const __m256i packed = _mm256_permutevar8x32_epi32(values, _mm256_cvtepu8_epi32(bytes));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), packed);
  return std::popcount(mask);
#else
  int count = 0;
  for (int lane = 0; lane < 8; ++lane) {
    to[count] = numbers[lane];
    count += chosen[lane] != 0 ? 1 : 0;
  }
  return count;
#endif
}

}  // namespace curlew
