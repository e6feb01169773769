// Spheres against geometry: each pixel's ray is cut with the sphere on paper, and the picture must agree. Far from the
// picture's middle a sphere seen in perspective is an ellipse; a shader that draws discs fails here.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "render/camera.h"
#include "render/context.h"
#include "tests/render/pictures.h"

using namespace curlew;
using namespace curlew::test;

namespace {

struct Ray {
  Vec3d origin, direction;
};

Ray ray_through(const View& view, int width, int height, int x, int y) {
  const double across = 2 * (x + 0.5) / width - 1, up = 1 - 2 * (y + 0.5) / height;
  const Vec3d aside = across * view.aspect * view.half_height * view.right + up * view.half_height * view.up;
  if (view.orthographic) return {view.position + aside, view.forward};
  const Vec3d direction = view.forward + aside;
  return {view.position, (1 / length(direction)) * direction};
}

// Draws one sphere and compares every third pixel. Returns how many pixels it covers there.
int compare_with_geometry(Vec3d centre, double radius, const Camera& camera, int dimension) {
  const int width = 240, height = 160;
  const Frame frame = frame_of({to_float(centre)}, radius, dimension);
  ViewSettings settings = bare_view();
  settings.camera = camera;
  Renderer renderer(width, height, 1);
  renderer.render(frame, settings);
  const View view = view_of(camera, frame.geometry->domain, dimension, 1.5, 0);
  const double pixel = 2 * view.half_height / height * (view.orthographic ? 1 : project(view, centre).z);

  int covered = 0, wrong = 0;
  double worst = 0;
  for (int y = 0; y < height; y += 3)
    for (int x = 0; x < width; x += 3) {
      const Ray ray = ray_through(view, width, height, x, y);
      const Vec3d to_centre = centre - ray.origin;
      const double along = dot(to_centre, ray.direction);
      const double aside = length(to_centre - along * ray.direction);
      if (std::abs(aside - radius) < pixel) continue;  // the rim is shared with what lies behind
      const auto seen = renderer.point_at(x, y);
      const bool expected = aside < radius;
      // In 2D the sheet behind the particles is seen where they are not.
      const bool found = seen && (dimension == 3 || seen->z > -radius);
      wrong += expected != found;
      if (!expected || !found) continue;
      ++covered;
      const Vec3d hit = ray.origin + (along - std::sqrt(radius * radius - aside * aside)) * ray.direction;
      worst = std::max(worst, length(*seen - hit) / radius);
    }
  CHECK(wrong == 0);
  CHECK(worst < 2e-3);
  return covered;
}

}  // namespace

TEST_CASE("a sphere covers the pixels and has the depth that geometry says") {
  const OffscreenContext context;
  Camera camera;
  camera.position = Vec3d{0, 0, 3};
  camera.target = Vec3d{0, 0, 0};
  camera.field_of_view = 60;
  SECTION("in the middle") { CHECK(compare_with_geometry({0, 0, 0}, 0.5, camera, 3) > 100); }
  SECTION("far aside, where it looks like an ellipse") {
    camera.field_of_view = 100;
    const int aside = compare_with_geometry({3.2, 1.4, 0.3}, 0.5, camera, 3);
    const int middle = compare_with_geometry({0, 0, 0.3}, 0.5, camera, 3);
    CHECK(aside > 1.3 * middle);
  }
  SECTION("so near that its silhouette is far wider than its radius") {
    CHECK(compare_with_geometry({0.1, 0, 2.1}, 0.7, camera, 3) > 100);
  }
  SECTION("cut by the edge of the picture, its centre outside") {
    CHECK(compare_with_geometry({2.8, 0, 0}, 0.7, camera, 3) > 20);
  }
  SECTION("a small one far away") { CHECK(compare_with_geometry({0.4, 0.3, -20}, 0.7, camera, 3) > 0); }
  SECTION("flat scenes are seen without perspective") { CHECK(compare_with_geometry({0.5, 0.3, 0}, 0.2, {}, 2) > 20); }
}

TEST_CASE("an eye inside a sphere, and positions that are no numbers, draw nothing") {
  const OffscreenContext context;
  const float nan = std::nanf("");
  ViewSettings settings = bare_view();
  settings.camera.position = Vec3d{0, 0, 3};
  settings.camera.target = Vec3d{0, 0, 0};
  Renderer renderer(64, 48, 1);
  const Image empty = renderer.draw(frame_of({}, 0.1), settings);
  CHECK(differing_pixels(empty, renderer.draw(frame_of({{0, 0, 3.05f}, {nan, 0, 0}}, 0.1), settings)) == 0);
  CHECK(differing_pixels(empty, renderer.draw(frame_of({{0, 0, 0}}, 0.1), settings)) > 10);
}

TEST_CASE("the rim of a lone drop fades into what lies behind it") {
  const OffscreenContext context;
  ViewSettings settings = bare_view();
  settings.camera.position = Vec3d{0, 0, 3};
  settings.camera.target = Vec3d{0, 0, 0};
  Renderer renderer(96, 96, 1);
  const Image without = renderer.draw(frame_of({}, 0.3), settings);
  const Image with = renderer.draw(frame_of({{0, 0, 0}}, 0.3), settings);
  int whole = 0, partial = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const int d = difference(with.at(x, y), without.at(x, y));
      whole += d > 100;
      partial += d > 8 && d <= 100;
    }
  // The silhouette's radius in pixels, and so its area, which whole and half covered pixels make up.
  const double radius = 48 * 0.3 / std::sqrt(9 - 0.09) / std::tan(17.5 * std::numbers::pi / 180);
  CHECK(whole + 0.5 * partial == Approx(std::numbers::pi * radius * radius).margin(20));
  CHECK(partial > 60);
}
