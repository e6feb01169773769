// The path of a body through its keyframes.
#include "sim/scene/keyframes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace curlew;

namespace {

// Forth, back, a halt, and uneven times.
KeyframePath winding() {
  return KeyframePath({{0.5, {0, 0, 1}},
                       {0.7, {0.1, 0.3, 1}},
                       {1.2, {0.5, 0.2, 1}},
                       {1.3, {0.5, -0.4, 1}},
                       {2.3, {0.9, -0.4, 1}},
                       {2.9, {-1, 0, 1.5}}});
}

}  // namespace

TEST_CASE("a path hits its keyframes and stands before the first and after the last", "[keyframes]") {
  const KeyframePath path = winding();
  for (const Keyframe& keyframe : path.keyframes()) {
    CAPTURE(keyframe.time);
    CHECK(path.at(keyframe.time).offset == keyframe.at);
    const BodyPlace before = path.at(std::nextafter(keyframe.time, 0));
    CHECK(length(before.offset - keyframe.at) < 1e-12);
  }
  CHECK(path.at(0.5).velocity == Vec3d{});
  CHECK(path.at(2.9).velocity == Vec3d{});
  for (const double time : {-1e300, 0.0, 0.4999}) {
    CHECK(path.at(time).offset == Vec3d{0, 0, 1});
    CHECK(path.at(time).velocity == Vec3d{});
  }
  CHECK(path.at(1e300).offset == Vec3d{-1, 0, 1.5});
  CHECK(path.at(1e300).velocity == Vec3d{});
}

TEST_CASE("a path's velocity is its derivative and continuous", "[keyframes]") {
  const KeyframePath path = winding();
  double sum = 0;
  for (int k = 0; k <= 3000; ++k) {
    const double time = k * 1e-3 + 1e-5, e = 1e-6;
    const Vec3d slope = (0.5 / e) * (path.at(time + e).offset - path.at(time - e).offset);
    sum = std::max(sum, length(slope - path.at(time).velocity));
  }
  CHECK(sum < 1e-6);
  for (const Keyframe& keyframe : path.keyframes()) {
    CAPTURE(keyframe.time);
    const double e = 1e-9;
    const Vec3d jump = path.at(keyframe.time + e).velocity - path.at(keyframe.time - e).velocity;
    CHECK(length(jump) < 1e-6);
  }
}

TEST_CASE("no coordinate of a path leaves the range between its keyframes", "[keyframes]") {
  const KeyframePath path = winding();
  const auto& keyframes = path.keyframes();
  for (std::size_t k = 0; k + 1 < keyframes.size(); ++k) {
    for (int n = 0; n <= 100; ++n) {
      const Vec3d x = path.at(keyframes[k].time + 0.01 * n * (keyframes[k + 1].time - keyframes[k].time)).offset;
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(x[axis] >= std::min(keyframes[k].at[axis], keyframes[k + 1].at[axis]) - 1e-12);
        CHECK(x[axis] <= std::max(keyframes[k].at[axis], keyframes[k + 1].at[axis]) + 1e-12);
      }
    }
  }
  CHECK(path.least() == Vec3d{-1, -0.4, 1});
  CHECK(path.most() == Vec3d{0.9, 0.3, 1.5});
}

TEST_CASE("between keyframes in line at even speed a path has that speed", "[keyframes]") {
  const KeyframePath path(
      {{0, {}}, {1, {0.5, 0, 0}}, {2, {2.5, 0, 0}}, {3, {4.5, 0, 0}}, {5, {8.5, 0, 0}}, {6, {9, 0, 0}}});
  for (const double time : {2.0, 2.1, 2.5, 3.0}) CHECK(path.at(time).velocity.x == Approx(2).epsilon(1e-12));
  CHECK(path.at(2.5).offset.x == Approx(3.5).epsilon(1e-12));
}

TEST_CASE("the top speed of a path bounds its speed and is reached along an axis", "[keyframes]") {
  const KeyframePath path = winding();
  for (const auto& [from, to] : {std::pair(0.0, 5.0), {0.55, 0.56}, {0.6, 1.25}, {1.25, 2.0}, {2.5, 9.0}}) {
    CAPTURE(from, to);
    double fastest = 0, fastest_along = 0;
    for (int n = 0; n <= 20000; ++n) {
      const Vec3d v = path.at(from + (to - from) * n / 20000).velocity;
      fastest = std::max(fastest, length(v));
      for (int axis = 0; axis < 3; ++axis) fastest_along = std::max(fastest_along, std::abs(v[axis]));
    }
    CHECK(path.top_speed(from, to) >= fastest * (1 - 1e-9));
    CHECK(path.top_speed(from, to) <= std::sqrt(3.0) * fastest_along * (1 + 1e-6));
  }
  const KeyframePath straight({{0, {}}, {1, {1, 0, 0}}});
  CHECK(straight.top_speed() == Approx(1.5));  // of 6 s (1 - s)
  CHECK(straight.top_speed(0, 0.25) == Approx(6 * 0.25 * 0.75));
  CHECK(straight.top_speed(1, 2) == 0);
  CHECK(straight.top_speed(-1, 0) == 0);
}

TEST_CASE("a path that stays where the scene has the body does not move it", "[keyframes]") {
  CHECK_FALSE(KeyframePath().moves());
  CHECK(KeyframePath().at(1).offset == Vec3d{});
  CHECK_FALSE(KeyframePath({{0, {}}, {1, {}}}).moves());
  CHECK(KeyframePath(std::vector{Keyframe{0, {0, 1, 0}}}).moves());  // it stands elsewhere
  CHECK(KeyframePath(std::vector{Keyframe{0, {0, 1, 0}}}).top_speed() == 0);
  CHECK(winding().moves_between(0, 0.6));
  CHECK_FALSE(winding().moves_between(0, 0.5));
  CHECK_FALSE(winding().moves_between(2.9, 4));
}
