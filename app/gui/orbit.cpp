#include "app/gui/orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double steepest = 0.495 * pi;  // nearer to the pole there is no up
constexpr double zoom_a_notch = 1.12;

Vec3d centre_of(const Domain& domain) { return 0.5 * (domain.min + domain.max); }

}  // namespace

Orbit::Orbit(const Camera& camera, const Domain& domain, int dimension, double aspect)
    : flat_(dimension == 2), field_of_view_(camera.field_of_view) {
  const View view = view_of(camera, domain, dimension, aspect);
  flat_height_ = 2 * view.half_height;
  if (flat_) {
    target_ = view.position;
    target_.z = 0;
    return;
  }
  const Vec3d centre = centre_of(domain);
  const double depth = dot(camera.target.value_or(centre) - view.position, view.forward);
  const double size = length(domain.max - domain.min);
  aim(view.position, view.position + (depth > 0.05 * size ? depth : size) * view.forward);
}

void Orbit::aim(Vec3d position, Vec3d target) {
  const Vec3d way = target - position;
  target_ = target;
  distance_ = length(way);
  yaw_ = std::atan2(way.x, -way.z);
  pitch_ = std::clamp(std::asin(std::clamp(way.y / distance_, -1.0, 1.0)), -steepest, steepest);
}

Vec3d Orbit::forward() const {
  return {std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), -std::cos(yaw_) * std::cos(pitch_)};
}

void Orbit::turn(double dx, double dy, double height) {
  if (flat_) return move(dx, dy, height);
  yaw_ += pi * dx / height;
  pitch_ = std::clamp(pitch_ - pi * dy / height, -steepest, steepest);
}

void Orbit::move(double dx, double dy, double height) {
  if (flat_) {
    const double metres = flat_height_ / flat_zoom_ / height;
    target_ = target_ + Vec3d{-metres * dx, metres * dy, 0};
    return;
  }
  const double metres = 2 * distance_ * std::tan(field_of_view_ / 360 * pi) / height;
  const Vec3d right{std::cos(yaw_), 0, std::sin(yaw_)};
  target_ = target_ - metres * dx * right + metres * dy * cross(right, forward());
}

void Orbit::zoom(double notches) {
  const double factor = std::pow(zoom_a_notch, notches);
  if (flat_) {
    flat_zoom_ = std::clamp(flat_zoom_ * factor, 0.1, 1000.0);
  } else {
    distance_ = std::clamp(distance_ / factor, 1e-6, 1e9);
  }
}

void Orbit::fit(const Domain& domain, double aspect) {
  const Vec3d centre = centre_of(domain);
  if (flat_) {
    target_ = view_of({}, domain, 2, aspect).position;
    target_.z = 0;
    flat_zoom_ = 1;
    return;
  }
  // A sphere around the domain touches the nearer pair of the picture's sides.
  const double half = field_of_view_ / 360 * pi, narrow = std::min(half, std::atan(std::tan(half) * aspect));
  target_ = centre;
  distance_ = 0.5 * length(domain.max - domain.min) / std::sin(narrow);
}

void Orbit::look_from(std::string_view side, const Domain& domain, double aspect) {
  pitch_ = side == "top" ? -steepest : side == "corner" ? -19 * pi / 180 : -4 * pi / 180;
  yaw_ = side == "back"     ? pi
         : side == "left"   ? pi / 2
         : side == "right"  ? -pi / 2
         : side == "corner" ? -30 * pi / 180
                            : 0;
  fit(domain, aspect);
}

Camera Orbit::camera() const {
  Camera camera;
  camera.field_of_view = field_of_view_;
  camera.target = target_;
  camera.position = flat_ ? target_ + Vec3d{0, 0, 1} : target_ - distance_ * forward();
  return camera;
}

}  // namespace curlew
