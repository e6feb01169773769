// Named velocity fields that fluid may begin with.
//
//   taylor_green  2D: U (-cos X sin Y, sin X cos Y);  3D: U cos Z (sin X cos Y, -cos X sin Y, 0), X = 2 pi x / L
//                 (Taylor & Green 1937)
//   shear_wave    (U sin Y, 0, 0)
//   rotation      rate x (x - centre)
//   gresho_chan   around z: v = U s for s = r / R < 1, U (2 - s) for 1 <= s < 2, else 0: a steady inviscid flow of
//                 which the first derivative jumps (Gresho & Chan 1990, with U = 1 m/s and R = 0.2 m)
//   lamb_oseen    around z: v = Gamma / (2 pi r) (1 - exp(-r^2 / a^2)): viscosity widens a^2 by 4 nu t (Lamb 1932,
//                 section 334a)
#include <cmath>
#include <numbers>

#include "sim/scene/sampling.h"

namespace curlew {
namespace {

Vec3d taylor_green(double speed, Vec3d p, const Scene& scene) {
  const auto phase = [&](int axis) {
    const double width = scene.domain.max[axis] - scene.domain.min[axis];
    return 2 * std::numbers::pi * (p[axis] - scene.domain.min[axis]) / width;
  };
  const double x = phase(0), y = phase(1);
  if (scene.dimension == 2) return {-speed * std::cos(x) * std::sin(y), speed * std::sin(x) * std::cos(y), 0};
  const double layer = speed * std::cos(phase(2));
  return {layer * std::sin(x) * std::cos(y), -layer * std::cos(x) * std::sin(y), 0};
}

Vec3d shear_wave(double speed, Vec3d p, const Scene& scene) {
  const double height = scene.domain.max.y - scene.domain.min.y;
  return {speed * std::sin(2 * std::numbers::pi * (p.y - scene.domain.min.y) / height), 0, 0};
}

double gresho_chan(double speed, double s) { return s < 1 ? speed * s : s < 2 ? speed * (2 - s) : 0; }

double lamb_oseen(double circulation, double core, double r) {
  // -expm1 keeps the core, where 1 - exp(-r^2/a^2) is all cancellation.
  return r > 0 ? circulation / (2 * std::numbers::pi * r) * -std::expm1(-r * r / (core * core)) : 0;
}

}  // namespace

double azimuthal_speed(const InitialVelocity& field, double r) {
  switch (field.field) {
    case InitialVelocity::Field::rotation:
      return field.rate.z * r;
    case InitialVelocity::Field::gresho_chan:
      return gresho_chan(field.speed, r / field.radius);
    case InitialVelocity::Field::lamb_oseen:
      return lamb_oseen(field.circulation, field.radius, r);
    default:
      return 0;
  }
}

Vec3d initial_velocity(const InitialVelocity& field, Vec3d p, const Scene& scene) {
  switch (field.field) {
    case InitialVelocity::Field::constant:
      return field.value;
    case InitialVelocity::Field::taylor_green:
      return taylor_green(field.speed, p, scene);
    case InitialVelocity::Field::shear_wave:
      return shear_wave(field.speed, p, scene);
    case InitialVelocity::Field::rotation:
      return cross(field.rate, p - field.centre);
    case InitialVelocity::Field::gresho_chan:
    case InitialVelocity::Field::lamb_oseen:
      break;
  }
  const Vec3d arm{p.x - field.centre.x, p.y - field.centre.y, 0};
  const double r = length(arm);
  return r > 0 ? azimuthal_speed(field, r) / r * Vec3d{-arm.y, arm.x, 0} : Vec3d{};
}

}  // namespace curlew
