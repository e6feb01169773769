// The few SIMD operations against plain loops.
#include "sim/core/simd.h"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace curlew;

TEST_CASE("gather transposes eight vectors", "[simd]") {
  std::vector<Vec3> from(20);
  for (int k = 0; k < 20; ++k) {
    const auto v = static_cast<float>(k);
    from[static_cast<std::size_t>(k)] = {v, 100 + v, 200 + v, 300 + v};
  }
  const std::uint32_t numbers[] = {3, 19, 0, 7, 7, 12, 1, 18};
  const Vec8 got = gather(from.data(), numbers);
  for (int lane = 0; lane < 8; ++lane) {
    const auto v = static_cast<float>(numbers[lane]);
    CHECK(got.x[lane] == v);
    CHECK(got.y[lane] == 100 + v);
    CHECK(got.z[lane] == 200 + v);
    CHECK(got.w[lane] == 300 + v);
  }
}

TEST_CASE("compress keeps the chosen numbers in order, for every mask", "[simd]") {
  const std::uint32_t numbers[] = {10, 11, 12, 13, 14, 15, 16, 17};
  for (unsigned mask = 0; mask < 256; ++mask) {
    i8 chosen{};
    std::vector<std::uint32_t> expected;
    for (int lane = 0; lane < 8; ++lane) {
      chosen[lane] = mask >> lane & 1u ? -1 : 0;
      if (mask >> lane & 1u) expected.push_back(numbers[lane]);
    }
    std::uint32_t to[8] = {};
    const int count = compress(numbers, chosen, to);
    REQUIRE(std::vector<std::uint32_t>(to, to + count) == expected);
  }
}

TEST_CASE("inverse_sqrt is good to a few units in the last place", "[simd]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-30, 30);
  for (int k = 0; k < 1000; ++k) {
    const float v = std::exp2(exponent(random));
    CHECK(inverse_sqrt(splat(v))[3] == Approx(1 / std::sqrt(double{v})).epsilon(4e-7));
  }
}

TEST_CASE("sum and nearest", "[simd]") {
  const f8 v{1, 2, 3, 4, 5, 6, 7, 8};
  CHECK(sum(v) == 36);
  const f8 r = nearest(f8{0.4f, 0.6f, -0.4f, -0.6f, 1.5f, 2.5f, -1.5f, 0});
  const float expected[] = {0, 1, 0, -1, 2, 2, -2, 0};
  for (int lane = 0; lane < 8; ++lane) CHECK(r[lane] == expected[lane]);
}
