#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/core/error.h"

namespace curlew {
namespace {

// How far from the middle a fitted domain reaches, in -1..1; to the right it leaves the legend's margin too.
constexpr double kLeft = 0.94, kBottom = 0.90, kTop = 0.90;

// From the front, a little from the side to which dam breaks run, and above: seen from there a wave shows its face.
constexpr double kAzimuth = 30, kElevation = 19;  // degrees

constexpr double kRadians = std::numbers::pi / 180;

Vec3d normalised(Vec3d a) { return (1 / length(a)) * a; }

std::array<Vec3d, 8> corners(const Domain& domain) {
  std::array<Vec3d, 8> all;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis)
      all[static_cast<std::size_t>(i)][axis] = (i >> axis & 1) ? domain.max[axis] : domain.min[axis];
  return all;
}

void look_along(View& view, Vec3d forward) {
  view.forward = normalised(forward);
  const Vec3d up = std::abs(view.forward.y) > 0.9999 ? Vec3d{0, 0, -view.forward.y} : Vec3d{0, 1, 0};
  view.right = normalised(cross(view.forward, up));
  view.up = cross(view.right, view.forward);
}

// How far back the four sides of the frustum push the eye so that all corners lie between them. Along one axis of the
// picture, with u the corner's coordinate there and z its depth: u - tan_high z <= c - tan_high e and
// u + tan_low z >= c + tan_low e, for an eye at (c, e). The outermost corner of each side decides.
struct Wedge {
  double high, low;  // max(u - tan_high z), min(u + tan_low z)
  double tan_high, tan_low;

  double nearest_eye() const { return (low - high) / (tan_high + tan_low); }
  double centre(double eye) const { return 0.5 * (high + tan_high * eye + low - tan_low * eye); }
};

Wedge wedge(const std::array<Vec3d, 8>& points, Vec3d axis, Vec3d forward, double tan_high, double tan_low) {
  Wedge w{-1e300, 1e300, tan_high, tan_low};
  for (const Vec3d& p : points) {
    w.high = std::max(w.high, dot(p, axis) - tan_high * dot(p, forward));
    w.low = std::min(w.low, dot(p, axis) + tan_low * dot(p, forward));
  }
  return w;
}

// Moves the eye, its direction fixed, to the nearest place from which all corners are in sight.
void fit(View& view, const Domain& domain, double right) {
  const auto points = corners(domain);
  const double half_width = view.half_height * view.aspect;
  const Wedge x = wedge(points, view.right, view.forward, right * half_width, kLeft * half_width);
  const Wedge y = wedge(points, view.up, view.forward, kTop * view.half_height, kBottom * view.half_height);
  const double eye = std::min(x.nearest_eye(), y.nearest_eye());
  view.position = x.centre(eye) * view.right + y.centre(eye) * view.up + eye * view.forward;
}

View perspective_view(const Camera& camera, const Domain& domain, double aspect, double right) {
  View view;
  view.aspect = aspect;
  view.half_height = std::tan(0.5 * camera.field_of_view * kRadians);
  const Vec3d centre = 0.5 * (domain.min + domain.max);
  const double size = length(domain.max - domain.min);
  const Vec3d from{std::sin(kAzimuth * kRadians) * std::cos(kElevation * kRadians), std::sin(kElevation * kRadians),
                   std::cos(kAzimuth * kRadians) * std::cos(kElevation * kRadians)};
  if (camera.position) {
    view.position = *camera.position;
    const Vec3d forward = camera.target.value_or(centre) - view.position;
    if (length(forward) < 1e-9 * size) throw InputError("camera.position and camera.target are the same point");
    look_along(view, forward);
  } else {
    look_along(view, -1.0 * from);
    fit(view, domain, right);
    if (camera.target) {  // look at the target from where all of the domain was in sight
      const double distance = dot(centre - view.position, view.forward);
      view.position = *camera.target - distance * view.forward;
    }
  }
  const double reach = length(centre - view.position) + size;
  view.near = 1e-3 * reach;
  view.far = 20 * reach;
  return view;
}

View flat_view(const Camera& camera, const Domain& domain, double aspect, double right) {
  View view;
  view.orthographic = true;
  view.aspect = aspect;
  look_along(view, {0, 0, -1});
  const Vec3d size = domain.max - domain.min;
  view.half_height = std::max(size.y / (kTop + kBottom), size.x / (aspect * (kLeft + right)));
  Vec3d centre = 0.5 * (domain.min + domain.max);
  centre.x += 0.5 * (kLeft - right) * view.half_height * aspect;
  if (camera.position) centre = *camera.position;
  if (camera.target) centre = *camera.target;
  const double depth = size.x + size.y;
  view.position = {centre.x, centre.y, depth};
  view.near = 1e-3 * depth;
  view.far = 2 * depth;
  return view;
}

}  // namespace

View view_of(const Camera& camera, const Domain& domain, int dimension, double aspect, double right_margin) {
  const double right = kLeft - 2 * right_margin;
  return dimension == 2 ? flat_view(camera, domain, aspect, right) : perspective_view(camera, domain, aspect, right);
}

Matrix4 View::world_to_view() const {
  Matrix4 matrix;
  set_row(matrix, 0, right, -dot(right, position));
  set_row(matrix, 1, up, -dot(up, position));
  set_row(matrix, 2, -1.0 * forward, dot(forward, position));
  return matrix;
}

Matrix4 View::view_to_world() const {
  Matrix4 matrix;
  for (int axis = 0; axis < 3; ++axis) {
    matrix.set(axis, 0, right[axis]);
    matrix.set(axis, 1, up[axis]);
    matrix.set(axis, 2, -forward[axis]);
    matrix.set(axis, 3, position[axis]);
  }
  return matrix;
}

Matrix4 View::view_to_clip() const {
  Matrix4 matrix;
  matrix.set(0, 0, 1 / (half_height * aspect));
  matrix.set(1, 1, 1 / half_height);
  if (orthographic) {
    matrix.set(2, 2, 1 / (far - near));
    matrix.set(2, 3, far / (far - near));
  } else {
    matrix.set(2, 2, near / (far - near));
    matrix.set(2, 3, near * far / (far - near));
    matrix.set(3, 2, -1);
    matrix.set(3, 3, 0);
  }
  return matrix;
}

Matrix4 View::clip_to_view() const {
  Matrix4 matrix;
  matrix.set(0, 0, half_height * aspect);
  matrix.set(1, 1, half_height);
  if (orthographic) {
    matrix.set(2, 2, far - near);
    matrix.set(2, 3, -far);
  } else {  // depth d of a point at distance s: d = near (far / s - 1) / (far - near)
    matrix.set(2, 2, 0);
    matrix.set(2, 3, -1);
    matrix.set(3, 2, (far - near) / (near * far));
    matrix.set(3, 3, 1 / far);
  }
  return matrix;
}

Vec3d project(const View& view, Vec3d point) {
  const Vec3d p = point - view.position;
  const double distance = dot(p, view.forward);
  const double scale = 1 / (view.half_height * (view.orthographic ? 1 : distance));
  return {scale * dot(p, view.right) / view.aspect, scale * dot(p, view.up), distance};
}

}  // namespace curlew
