// Drawn sizes: full inside the water, small for drops that fly alone, and changing smoothly on the way.
#include "render/drop_size.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/render/pictures.h"

using namespace curlew;
using namespace curlew::test;

namespace {

// A block of water in the lower half of the box, and one drop high above it, last.
Frame block_and_drop(int dimension, float drop_height = 0.7f) {
  Frame frame = slope_of_water(dimension);
  std::erase_if(frame.position, [](const Vec3& p) { return p.y > -0.1f; });
  frame.position.push_back({0, drop_height, 0});
  return frame;
}

}  // namespace

TEST_CASE("crowding is one inside the water, about a half at its surface, almost nothing alone") {
  for (const int dimension : {2, 3}) {
    const Frame frame = block_and_drop(dimension);
    const auto crowded = crowding(frame.position, frame.geometry->domain, dimension, 0.1);
    for (std::size_t i = 0; i + 1 < frame.position.size(); ++i) {
      const Vec3 p = frame.position[i];
      const bool inside = std::abs(p.x) < 0.5f && p.y > -0.7f && p.y < -0.4f && std::abs(p.z) < 0.5f;
      if (inside) CHECK(static_cast<double>(crowded[i]) == Approx(1).margin(0.25));
    }
    CHECK(static_cast<double>(crowded.back()) < (dimension == 3 ? 0.04 : 0.12));
  }
}

TEST_CASE("a drop alone is small, water is full, and a given size is the same for all") {
  const Frame frame = block_and_drop(3);
  const auto sized = sized_particles(frame, kDropSize3d);
  CHECK(static_cast<double>(sized.back().w) == Approx(kDropSize3d.alone / kDropSize3d.in_water).epsilon(0.01));
  double largest = 0;
  for (const Vec3& p : sized) largest = std::max(largest, static_cast<double>(p.w));
  CHECK(largest == 1);
  for (const Vec3& p : sized_particles(frame, {1, 1})) CHECK(p.w == 1);
}

TEST_CASE("a drop that falls into the water grows without a jump") {
  float before = -1;
  for (float height = 0.7f; height > -0.3f; height -= 0.005f) {
    const float size = sized_particles(block_and_drop(3, height), kDropSize3d).back().w;
    if (before > 0) CHECK(std::abs(size - before) < 0.06f);
    before = size;
  }
  CHECK(before > 0.9f);
}

TEST_CASE("stray particles and vast domains do no harm") {
  Frame frame = block_and_drop(3);
  frame.position.push_back({1e30f, -1e30f, std::nanf("")});
  CHECK(sized_particles(frame, kDropSize3d).size() == frame.position.size());
  Domain vast;
  vast.min = {-1e6, -1e6, -1e6};
  vast.max = {1e6, 1e6, 1e6};
  CHECK(crowding(frame.position, vast, 3, 0.01).size() == frame.position.size());
}
