// Clear water: seen through, and nothing where there is none.
#include <catch2/catch.hpp>

#include "render/context.h"
#include "sim/surface/surface.h"
#include "tests/render/pictures.h"

using namespace curlew;
using namespace curlew::test;

namespace {

// A block of water from wall to wall, `height` high, in the domain of frame_of().
Frame pool(double height, LookStyle style, bool with_pillar = false) {
  std::vector<Vec3> positions;
  const float step = 0.05f;
  for (float x = -0.975f; x < 1; x += step)
    for (float y = -0.975f; y < static_cast<float>(height) - 1; y += step)
      for (float z = -0.975f; z < 1; z += step) positions.push_back({x, y, z});
  Frame frame = frame_of(positions, 0.5 * static_cast<double>(step));
  auto geometry = std::make_shared<FrameGeometry>(*frame.geometry);
  if (with_pillar) {
    TriangleMesh wall;
    wall.vertices = {{-0.3, -1, 0}, {0.3, -1, 0}, {0.3, 0.9, 0}, {-0.3, 0.9, 0}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    geometry->bodies.push_back({"pillar", wall});
  }
  frame.geometry = geometry;
  if (style == LookStyle::water) {
    Scene scene;
    scene.domain = geometry->domain;
    scene.particle_radius = geometry->particle_radius;
    SurfaceMaker maker;
    frame.surface = std::make_shared<const SurfaceMesh>(maker.make({frame.position, {}}, scene));
  }
  return frame;
}

ViewSettings view(LookStyle style) {
  ViewSettings settings;
  settings.look.style = style;
  settings.look.show_walls = settings.look.show_legend = false;
  settings.camera.position = Vec3d{0.4, 1.4, 4};
  settings.camera.target = Vec3d{0, -0.5, 0};
  return settings;
}

struct Mean {
  double red = 0, green = 0, blue = 0;
};

Mean mean(const Image& image, int x0, int y0, int x1, int y1) {
  Mean m;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      m.red += image.at(x, y)[0];
      m.green += image.at(x, y)[1];
      m.blue += image.at(x, y)[2];
    }
  }
  const double n = (x1 - x0) * (y1 - y0);
  return {m.red / n, m.green / n, m.blue / n};
}

}  // namespace

TEST_CASE("deeper water takes more of the light, red first, in both looks") {
  const OffscreenContext context;
  Renderer renderer(320, 240, 1);
  for (const LookStyle style : {LookStyle::water, LookStyle::fast_water}) {
    CAPTURE(static_cast<int>(style));
    double last_red = 256;
    for (const double height : {0.1, 0.4, 0.9}) {
      const Image image = renderer.draw(pool(height, style), view(style));
      const Mean m = mean(image, 120, 170, 200, 190);
      CHECK(m.red < last_red - 5);
      CHECK(m.blue > m.red + 10);
      last_red = m.red;
    }
  }
}

TEST_CASE("the same water gives the same bits, and none gives the picture without") {
  const OffscreenContext context;
  for (const LookStyle style : {LookStyle::water, LookStyle::fast_water}) {
    Renderer first(320, 180), second(320, 180);
    const Frame frame = pool(0.5, style);
    CHECK(first.draw(frame, view(style)).rgba == second.draw(frame, view(style)).rgba);
    Frame dry = frame_of({}, 0.025);
    if (style == LookStyle::water) dry.surface = std::make_shared<const SurfaceMesh>();
    const Image empty = second.draw(frame_of({}, 0.025), view(LookStyle::particles));
    CHECK(differing_pixels(second.draw(dry, view(style)), empty, 1) == 0);
    CHECK(first.draw(frame, view(style)).rgba == first.draw(frame, view(style)).rgba);
  }
}

TEST_CASE("both looks of water show the same water") {
  const OffscreenContext context;
  Renderer renderer(320, 240, 1);
  const Image mesh = renderer.draw(pool(0.6, LookStyle::water), view(LookStyle::water));
  const Image screen = renderer.draw(pool(0.6, LookStyle::fast_water), view(LookStyle::fast_water));
  const Image none = renderer.draw(frame_of({}, 0.025), view(LookStyle::particles));
  CHECK(differing_pixels(mesh, none, 30) > 10000);
  CHECK(differing_pixels(screen, none, 30) > 10000);
  CHECK(differing_pixels(mesh, screen, 60) < 2500);
}

TEST_CASE("a pool has no holes: every pixel of its front wall is water") {
  const OffscreenContext context;
  Renderer renderer(320, 240, 1);
  for (const LookStyle style : {LookStyle::water, LookStyle::fast_water}) {
    const Image wet = renderer.draw(pool(0.8, style), view(style));
    const Image dry = renderer.draw(frame_of({}, 0.025), view(LookStyle::particles));
    int unchanged = 0;
    for (int y = 150; y < 190; ++y)
      for (int x = 100; x < 220; ++x) unchanged += difference(wet.at(x, y), dry.at(x, y)) < 20 ? 1 : 0;
    CAPTURE(static_cast<int>(style));
    CHECK(unchanged == 0);
  }
}

TEST_CASE("a solid is seen through the water, bent and blue, and as ever above it") {
  const OffscreenContext context;
  Renderer renderer(320, 240, 1);
  for (const LookStyle style : {LookStyle::water, LookStyle::fast_water}) {
    const Image wet = renderer.draw(pool(0.8, style, true), view(style));
    Frame without = pool(0.8, style);
    const Image open = renderer.draw(without, view(style));
    Frame dry_frame = frame_of({}, 0.025);
    dry_frame.geometry = pool(0.1, LookStyle::fast_water, true).geometry;
    const Image dry = renderer.draw(dry_frame, view(LookStyle::particles));
    const Mean above_wet = mean(wet, 150, 70, 165, 80), above_dry = mean(dry, 150, 70, 165, 80);
    CAPTURE(static_cast<int>(style));
    CHECK(above_wet.red == Approx(above_dry.red).margin(6));
    const Mean below_wet = mean(wet, 150, 150, 165, 170), below_dry = mean(dry, 150, 150, 165, 170),
               below_open = mean(open, 150, 150, 165, 170);
    CHECK(below_wet.red < below_dry.red - 15);
    CHECK(std::abs(below_wet.red - below_open.red) + std::abs(below_wet.green - below_open.green) > 4);
  }
}

TEST_CASE("drafts and larger pictures of water") {
  const OffscreenContext context;
  Renderer renderer(160, 120);
  for (const LookStyle style : {LookStyle::water, LookStyle::fast_water}) {
    const Frame frame = pool(0.5, style);
    const Image whole = renderer.draw(frame, view(style));
    renderer.render(frame, view(style), Renderer::Detail::draft);
    CHECK(differing_pixels(renderer.read(), whole, 60) < 1500);
    renderer.resize(240, 180);
    CHECK(renderer.draw(frame, view(style)).width == 240);
    renderer.resize(160, 120);
    CHECK(renderer.draw(frame, view(style)).rgba == whole.rgba);
  }
}
