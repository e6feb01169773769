// Colour maps: ends and middles against the published definitions, and the scale of a frame's values.
#include "render/colour_maps.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "render/colour_range.h"
#include "sim/core/error.h"
#include "sim/scene/names.h"
#include "tests/render/pictures.h"

using namespace curlew;
using namespace curlew::test;

namespace {

double luminance(Rgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

Frame values(std::vector<float> v) {
  Frame frame = frame_of({}, 0.1);
  frame.value = std::move(v);
  return frame;
}

}  // namespace

TEST_CASE("colour maps begin and end where their authors put them") {
  CHECK(colour_map("viridis").front() == Rgb{68, 1, 84});
  CHECK(colour_map("viridis").back() == Rgb{253, 231, 37});
  CHECK(colour_map("magma").front() == Rgb{0, 0, 4});
  CHECK(colour_map("magma").back() == Rgb{252, 253, 191});
  CHECK(colour_map("turbo").front() == Rgb{48, 18, 59});
  CHECK(colour_map("turbo").back() == Rgb{122, 4, 3});
  CHECK(colour_map("coolwarm").front() == Rgb{59, 76, 192});
  CHECK(colour_map("coolwarm").back() == Rgb{180, 4, 38});
  const Rgb middle = colour_map("coolwarm")[128];  // Moreland's unsaturated middle is 221, 221, 221
  CHECK(std::abs(middle.r - 221) <= 2);
  CHECK(std::abs(middle.g - 221) <= 2);
  CHECK(std::abs(middle.b - 221) <= 2);
}

TEST_CASE("water, viridis, magma and grey grow lighter all the way") {
  for (const char* name : {"water", "viridis", "magma", "grey"}) {
    const auto& map = colour_map(name);
    for (std::size_t i = 8; i < map.size(); i += 8) CHECK(luminance(map[i]) > luminance(map[i - 8]));
  }
}

TEST_CASE("every map that a scene may name exists, and no other") {
  for (const std::string_view name : colour_map_names()) CHECK_NOTHROW(colour_map(name));
  CHECK_THROWS_WITH(colour_map("jet"),
                    "look.colour_map is \"jet\", expected one of water, viridis, magma, turbo, coolwarm, grey");
}

TEST_CASE("a colour scale spans what a frame holds") {
  using Range = std::array<double, 2>;
  CHECK(colour_range(values({})) == Range{0, 1});
  CHECK(colour_range(values({0.2f, 1, 2})) == Range{0, 2});      // near zero: from zero
  CHECK(colour_range(values({90, 95, 100})) == Range{90, 100});  // far from zero: not
  CHECK(colour_range(values({-1, 0, 4})) == Range{-4, 4});       // both signs: the middle is zero
  CHECK(colour_range(values({-4, -1})) == Range{-4, -1});
  const Range flat = colour_range(values({5, 5, 5}));
  CHECK(flat[1] > flat[0]);
  CHECK(colour_range(values({0, 1, std::numeric_limits<float>::infinity(), std::nanf("")})) == Range{0, 1});

  std::vector<float> many(10000, 1.f);
  many[17] = 1000.f;  // one wild particle
  CHECK(colour_range(values(many))[1] < 2);
  CHECK(united({0, 1}, {-2, 0.5}) == Range{-2, 1});
}
