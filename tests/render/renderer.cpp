// Whole pictures: the same bits each time, and what a scene's look switches on and off.
#include "render/renderer.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "render/colour_maps.h"
#include "render/context.h"
#include "render/solids.h"
#include "render/walls.h"
#include "sim/core/error.h"
#include "tests/render/pictures.h"

using namespace curlew;
using namespace curlew::test;

namespace {

std::shared_ptr<FrameGeometry> with_pillar(const Frame& frame) {
  auto geometry = std::make_shared<FrameGeometry>(*frame.geometry);
  TriangleMesh wall;
  wall.vertices = {{0.2, -1, 0.9}, {0.8, -1, 0.9}, {0.8, 0.5, 0.9}, {0.2, 0.5, 0.9}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  geometry->bodies.push_back({"pillar", wall});
  return geometry;
}

}  // namespace

TEST_CASE("the same frame gives the same bits") {
  const OffscreenContext context;
  for (const int dimension : {2, 3}) {
    const Frame frame = slope_of_water(dimension);
    Renderer first(320, 180), second(320, 180);
    const Image a = first.draw(frame, {}), b = first.draw(frame, {}), c = second.draw(frame, {});
    CHECK(a.rgba == b.rgba);
    CHECK(a.rgba == c.rgba);
  }
}

TEST_CASE("each part of the look changes the picture, and every pixel is opaque") {
  const OffscreenContext context;
  Frame frame = slope_of_water();
  Renderer renderer(640, 400, 1);
  const Image usual = renderer.draw(frame, {});
  for (std::size_t i = 3; i < usual.rgba.size(); i += 4)
    if (usual.rgba[i] != 255) FAIL("a pixel is not opaque");

  ViewSettings settings;
  const auto changed = [&] { return differing_pixels(usual, renderer.draw(frame, settings), 8); };
  CHECK(changed() == 0);
  SECTION("walls") {
    settings.look.show_walls = false;
    CHECK(changed() > 500);
  }
  SECTION("floor") {
    settings.look.show_floor = false;
    CHECK(changed() > 2000);
  }
  SECTION("colour map") {
    settings.look.colour_map = "magma";
    CHECK(changed() > 20000);
  }
  SECTION("dark background") {
    settings.look.background = "dark";
    CHECK(changed() > 100000);
  }
  SECTION("range") {
    settings.look.range = {{0, 10}};
    CHECK(changed() > 5000);
  }
  SECTION("no values: plain water, no scale") {
    frame.value.clear();
    CHECK(changed() > 20000);
  }
  SECTION("bodies") {
    frame.geometry = with_pillar(frame);
    CHECK(changed() > 2000);
  }
}

TEST_CASE("a body is drawn where the frame has it") {
  const OffscreenContext context;
  Frame frame = slope_of_water(), elsewhere = frame;
  frame.geometry = with_pillar(frame);
  auto moved = std::make_shared<FrameGeometry>(*frame.geometry);
  for (Vec3d& corner : moved->bodies[0].surface.vertices) corner += Vec3d{0.25, -0.125, 0};
  elsewhere.geometry = moved;
  Renderer renderer(640, 400), fresh(640, 400);
  const Image start = renderer.draw(frame, {});
  frame.body_offset = {{0.25, -0.125, 0}};
  const Image there = renderer.draw(frame, {});
  CHECK(differing_pixels(start, there, 8) > 500);
  CHECK(there.rgba == fresh.draw(elsewhere, {}).rgba);
  frame.body_offset = {{}};
  CHECK(renderer.draw(frame, {}).rgba == start.rgba);
}

TEST_CASE("the legend shows the map's own colours") {
  const OffscreenContext context;
  Renderer renderer(1280, 720);
  ViewSettings settings;
  settings.look.colour_map = "turbo";
  const Image image = renderer.draw(slope_of_water(), settings);
  // Somewhere in the right tenth stands a column that runs through the whole map.
  const auto& map = colour_map("turbo");
  int columns = 0;
  for (int x = 1150; x < 1280; ++x) {
    std::size_t found = 0;
    for (const std::size_t i : {0u, 64u, 128u, 192u, 255u})
      for (int y = 200; y < 520; ++y) {
        const std::uint8_t* p = image.at(x, y);
        if (Rgb{p[0], p[1], p[2]} == map[i]) {
          ++found;
          break;
        }
      }
    columns += found == 5;
  }
  CHECK(columns >= 10);
}

TEST_CASE("a picture changes its size") {
  const OffscreenContext context;
  const Frame frame = slope_of_water();
  Renderer renderer(200, 100), fresh(333, 77);
  renderer.draw(frame, {});
  renderer.resize(333, 77);
  const Image image = renderer.draw(frame, {});
  CHECK(image.width == 333);
  CHECK(image.height == 77);
  CHECK(image.rgba == fresh.draw(frame, {}).rgba);
  CHECK_NOTHROW(Renderer(1, 1).draw(frame, {}));
}

TEST_CASE("looks and sizes that make no sense are errors") {
  const OffscreenContext context;
  Renderer renderer(64, 64);
  ViewSettings settings;
  settings.look.background = "pink";
  CHECK_THROWS_WITH(renderer.draw(slope_of_water(), settings),
                    "look.background is \"pink\", expected \"light\" or \"dark\"");
  CHECK_THROWS_AS(Renderer(0, 10), InputError);
  CHECK_THROWS_AS(Renderer(10, 1000000), InputError);
}

TEST_CASE("supersampling and a growing number of particles work") {
  const OffscreenContext context;
  Renderer renderer(160, 90, 3);
  for (const int count : {0, 1, 10, 5000}) {
    Frame frame = frame_of(std::vector<Vec3>(static_cast<std::size_t>(count), Vec3{0, 0, 0}), 0.2);
    CHECK(renderer.draw(frame, {}).width == 160);
  }
}

TEST_CASE("meshes are drawn round where they are round and sharp where they are sharp") {
  TriangleMesh roof;  // two slopes that meet at the top edge, at 90 degrees
  roof.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 0}, {2, 0, 1}, {2, 0, 0}};
  roof.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}, {0, 0, 1}};
  const auto sharp = drawn_triangles(roof);
  REQUIRE(sharp.size() == 12);  // the triangle without area is left out
  CHECK(std::abs(sharp[0].nx) == Approx(std::numbers::sqrt2 / 2));
  CHECK(std::abs(sharp[2].nx) == Approx(std::numbers::sqrt2 / 2));  // on the edge, but of its own slope only

  for (auto& v : roof.vertices) v.y *= 0.1;
  const auto round = drawn_triangles(roof);
  CHECK(std::abs(round[2].nx) < 0.5 * std::abs(round[0].nx));  // on the edge the slopes share a normal
}

TEST_CASE("the box of a scene has twelve edges, fewer faces behind, and no walls where it is open") {
  Domain domain;
  domain.min = {0, 0, 0};
  domain.max = {1, 1, 1};
  const Vec3d eye{3, 2, 4};
  CHECK(wall_edges(domain, 3, eye).size() == 12);
  CHECK(back_faces(domain, 3, eye).size() == 2);  // x- and z-; the floor is drawn as a floor
  CHECK(wall_edges(domain, 2, eye).size() == 4);
  CHECK(back_faces(domain, 2, eye).empty());
  domain.walls[0].kind = WallKind::open;
  domain.periodic[2] = true;
  CHECK(back_faces(domain, 3, eye).empty());
}
