// Cameras against their definition: what is in sight, where points fall, and that matrices and their inverses agree.
#include "render/camera.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/error.h"

using namespace curlew;

namespace {

Domain box(Vec3d min, Vec3d max) {
  Domain domain;
  domain.min = min;
  domain.max = max;
  return domain;
}

std::array<double, 4> times(const Matrix4& m, std::array<double, 4> v) {
  std::array<double, 4> out{};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      out[static_cast<std::size_t>(row)] += m(row, column) * v[static_cast<std::size_t>(column)];
  return out;
}

// The rectangle over which the corners of a domain fall, in -1..1.
struct Extent {
  double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;
};

Extent extent_of(const View& view, const Domain& domain) {
  Extent e;
  for (int i = 0; i < 8; ++i) {
    const Vec3d corner{i & 1 ? domain.max.x : domain.min.x, i & 2 ? domain.max.y : domain.min.y,
                       i & 4 ? domain.max.z : domain.min.z};
    const Vec3d at = project(view, corner);
    CHECK(at.z > view.near);
    CHECK(at.z < view.far);
    e.left = std::min(e.left, at.x);
    e.right = std::max(e.right, at.x);
    e.bottom = std::min(e.bottom, at.y);
    e.top = std::max(e.top, at.y);
  }
  return e;
}

}  // namespace

TEST_CASE("a camera without a place shows the whole domain, as large as fits") {
  for (const Domain& domain : {box({0, 0, 0}, {2, 2, 1}), box({-5, 1, -5}, {5, 1.2, 5}), box({0, 0, 0}, {0.1, 3, 0.1})})
    for (const double aspect : {16.0 / 9, 1.0, 0.5})
      for (const double field_of_view : {20.0, 35.0, 90.0})
        for (const double margin : {0.0, 0.1}) {
          Camera camera;
          camera.field_of_view = field_of_view;
          const Extent e = extent_of(view_of(camera, domain, 3, aspect, margin), domain);
          CHECK(e.left >= -0.9401);
          CHECK(e.right <= 0.9401 - 2 * margin);
          CHECK(e.bottom >= -0.9001);
          CHECK(e.top <= 0.9001);
          const bool fills_width = e.left < -0.93 && e.right > 0.93 - 2 * margin;
          const bool fills_height = e.bottom < -0.89 && e.top > 0.89;
          CHECK((fills_width || fills_height));
        }
}

TEST_CASE("a flat scene is seen straight on and whole") {
  const Domain domain = box({0, 0, 0}, {2, 1, 0});
  const View view = view_of({}, domain, 2, 16.0 / 9, 0.1);
  CHECK(view.orthographic);
  CHECK(length(view.forward - Vec3d{0, 0, -1}) == Approx(0).margin(1e-12));
  const Extent e = extent_of(view, domain);
  CHECK(e.left >= -0.9401);
  CHECK(e.right <= 0.7401);
  CHECK(e.top <= 0.9001);

  Camera aside;
  aside.target = Vec3d{0.5, 0.25, 0};
  const Vec3d at = project(view_of(aside, domain, 2, 16.0 / 9), {0.5, 0.25, 0});
  CHECK(at.x == Approx(0).margin(1e-12));
  CHECK(at.y == Approx(0).margin(1e-12));
}

TEST_CASE("a given camera looks from its position to its target") {
  Camera camera;
  camera.position = Vec3d{0, 1, 3};
  camera.target = Vec3d{0, 1, 0};
  camera.field_of_view = 90;
  const View view = view_of(camera, box({-1, 0, -1}, {1, 2, 1}), 3, 2);
  const Vec3d middle = project(view, {0, 1, 0}), top_right = project(view, {6, 4, 0});
  CHECK(middle.x == Approx(0).margin(1e-12));
  CHECK(middle.y == Approx(0).margin(1e-12));
  CHECK(middle.z == Approx(3));
  CHECK(top_right.x == Approx(1));  // 45 degrees up; twice as wide as high
  CHECK(top_right.y == Approx(1));
}

TEST_CASE("a camera may look straight down, but not at itself") {
  Camera camera;
  camera.position = Vec3d{0, 5, 0};
  camera.target = Vec3d{0, 0, 0};
  const View view = view_of(camera, box({-1, 0, -1}, {1, 2, 1}), 3, 1);
  CHECK(length(view.right) == Approx(1));
  CHECK(dot(view.right, view.up) == Approx(0).margin(1e-12));
  camera.target = camera.position;
  CHECK_THROWS_WITH(view_of(camera, box({-1, 0, -1}, {1, 2, 1}), 3, 1),
                    "camera.position and camera.target are the same point");
}

TEST_CASE("matrices say the same as the projection, and their inverses lead back") {
  for (const int dimension : {2, 3}) {
    const View view = view_of({}, box({0, 0, 0}, {2, 1, dimension == 3 ? 1.0 : 0.0}), dimension, 1.5);
    const Vec3d p{0.3, 0.7, 0.1}, expected = project(view, p);
    const auto eye = times(view.world_to_view(), {p.x, p.y, p.z, 1});
    const auto clip = times(view.view_to_clip(), eye);
    CHECK(clip[0] / clip[3] == Approx(expected.x).margin(1e-5));
    CHECK(clip[1] / clip[3] == Approx(expected.y).margin(1e-5));
    CHECK(-eye[2] == Approx(expected.z).epsilon(1e-5));

    const auto back = times(view.clip_to_view(), {clip[0] / clip[3], clip[1] / clip[3], clip[2] / clip[3], 1});
    for (std::size_t i = 0; i < 3; ++i) CHECK(back[i] / back[3] == Approx(eye[i]).margin(1e-4));
    const auto world = times(view.view_to_world(), eye);
    for (std::size_t i = 0; i < 3; ++i) CHECK(world[i] == Approx(p[static_cast<int>(i)]).margin(1e-5));
  }
}

TEST_CASE("depth runs from one at the near plane to zero at the far plane") {
  for (const int dimension : {2, 3}) {
    const View view = view_of({}, box({0, 0, 0}, {2, 1, 1}), dimension, 1);
    const auto near = times(view.view_to_clip(), {0, 0, -view.near, 1});
    const auto far = times(view.view_to_clip(), {0, 0, -view.far, 1});
    CHECK(near[2] / near[3] == Approx(1));
    CHECK(far[2] / far[3] == Approx(0).margin(1e-6));
  }
}
