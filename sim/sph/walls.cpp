#include "sim/sph/walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;

Vec3 times(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// Integral of f(r) over a k-flat at distance s from the origin, out to r = end; f is smooth but for a kink at end/2.
template <class F>
double flat_integral(int k, double s, double end, F&& f) {
  if (k == 0) return f(s);
  const double reach = std::sqrt(std::max(0.0, end * end - s * s));
  constexpr int steps = 800;
  double total = 0;
  for (int n = 0; n < steps; ++n) {
    const double t = (n + 0.5) * reach / steps;
    total += f(std::sqrt(s * s + t * t)) * (k == 1 ? 2.0 : 2 * pi * t);
  }
  return total * reach / steps;
}

}  // namespace

Walls::Walls(const Domain& domain, int dimension, const Kernel& kernel, double spacing, double mass)
    : dimension_(dimension),
      spacing_(static_cast<float>(spacing)),
      support_(static_cast<float>(kernel.support())),
      layers_(static_cast<int>(std::ceil(kernel.support() / spacing - 0.5))) {
  for (int axis = 0; axis < dimension; ++axis) {
    if (domain.periodic[axis]) continue;
    for (int high = 0; high < 2; ++high) {
      const Wall& wall = domain.walls[2 * axis + high];
      if (wall.kind == WallKind::open) continue;
      const double plane = high ? domain.max[axis] : domain.min[axis];
      faces_.push_back({axis, high ? -1.0f : 1.0f, static_cast<float>(plane), wall.kind == WallKind::no_slip,
                        to_float(wall.velocity)});
    }
  }
  const double end = kernel.support();
  for (int k = 0; k < dimension; ++k) {
    const double scale = mass / std::pow(spacing, k);
    const auto value = [&](double s) {
      return scale * flat_integral(k, s, end, [&](double r) { return kernel.value(r); });
    };
    const auto slope = [&](double s) {
      return scale * flat_integral(k, s, end, [&](double r) { return r > 0 ? kernel.derivative(r) * s / r : 0.0; });
    };
    flat_[k].fill(end, value, slope);
  }
  const auto friction = [&](double s) {
    return spacing * flat_integral(dimension - 1, s, end, [&](double r) {
             return 2 * r * -kernel.derivative(r) / (r * r + kernel.softening());
           });
  };
  friction_.fill(end, friction, [&](double s) {
    const double e = 1e-4 * end;
    return (friction(std::min(end, s + e)) - friction(std::max(0.0, s - e))) /
           (std::min(end, s + e) - std::max(0.0, s - e));
  });
}

bool Walls::any_no_slip() const {
  return std::any_of(faces_.begin(), faces_.end(), [](const Face& face) { return face.no_slip; });
}

float Walls::lattice_points(float a) const {
  const float r = support_, height = r - a;
  if (dimension_ == 3) {
    return std::numbers::pi_v<float> * height * height * (2 * r + a) / (3 * spacing_ * spacing_ * spacing_);
  }
  return (r * r * std::acos(a / r) - a * std::sqrt(r * r - a * a)) / (spacing_ * spacing_);
}

// How far from a particle at `distance` from a face its layer of that number lies, and the rate at which that changes.
Walls::Layer Walls::layer(int number, float distance) const {
  if (number == 0) return {2 * distance, 2};
  return {distance + (static_cast<float>(number) + 0.5f) * spacing_, 1};
}

void Walls::add_face(WallSum& total, const Near& near) const {
  const Face& face = *near.face;
  total.neighbours += lattice_points(near.distance);
  for (int number = 0; number < layers_; ++number) {
    const auto [s, rate] = layer(number, near.distance);
    const auto [value, slope] = flat_[dimension_ - 1].at(s);
    total.gradient.w += value;
    total.gradient[face.axis] += face.side * rate * slope;
    total.virial[face.axis] -= near.distance * rate * slope;
    if (!face.no_slip) continue;
    // 1 + s_b/a: two for the mirrored layer; bounded as Morris et al. do where a particle nears the plane.
    const float behind = (s - near.distance) / std::max(near.distance, 1e-6f * spacing_);
    const float pull = friction_.at(s).value * (1 + std::min(1.5f, behind));
    total.friction += pull * face.velocity;
    total.friction.w += pull;
  }
}

// What `number` faces (2: an edge, 3: a corner) count more than once: one I_(D-number) for each combination of layers.
void Walls::add_overlap(WallSum& total, const Near* const* near, int number) const {
  const float sign = number == 2 ? -1.0f : 1.0f;
  const int combinations = number == 2 ? layers_ * layers_ : layers_ * layers_ * layers_;
  for (int combination = 0; combination < combinations; ++combination) {
    Layer depth[3] = {};
    float squared = 0;
    for (int f = 0, rest = combination; f < number; ++f, rest /= layers_) {
      depth[f] = layer(rest % layers_, near[f]->distance);
      squared += depth[f].distance * depth[f].distance;
    }
    if (squared >= support_ * support_) continue;
    const float s = std::sqrt(squared);
    const auto [value, slope] = flat_[dimension_ - number].at(s);
    const float slope_over_s = slope / std::max(s, 1e-6f * spacing_);
    total.gradient.w += sign * value;
    for (int f = 0; f < number; ++f) {
      const float push = sign * depth[f].rate * slope_over_s * depth[f].distance;
      total.gradient[near[f]->face->axis] += near[f]->face->side * push;
      total.virial[near[f]->face->axis] -= near[f]->distance * push;
    }
  }
}

WallSum Walls::sum(Vec3 position) const {
  WallSum total;
  Near near[most_near];
  int number = 0;
  for (const Face& face : faces_) {
    const float distance = std::max(0.0f, face.side * (position[face.axis] - face.plane));
    if (distance < support_) near[number++] = {&face, distance};
  }
  for (int a = 0; a < number; ++a) {
    add_face(total, near[a]);
    for (int b = a + 1; b < number; ++b) {
      if (near[a].face->axis == near[b].face->axis) continue;
      const Near* pair[] = {&near[a], &near[b]};
      add_overlap(total, pair, 2);
      for (int c = b + 1; c < number && dimension_ == 3; ++c) {
        if (near[c].face->axis == near[a].face->axis || near[c].face->axis == near[b].face->axis) continue;
        const Near* triple[] = {&near[a], &near[b], &near[c]};
        add_overlap(total, triple, 3);
      }
    }
  }
  return total;
}

int Walls::reflections(Vec3 position, Reflection* found) const {
  int number = 0;
  for (const Face& face : faces_) {
    const float x = position[face.axis] - face.plane;
    if (std::abs(x) >= support_) continue;
    Reflection own;
    own.sign[face.axis] = -1;
    own.offset[face.axis] = 2 * x;
    for (int axis = 0; axis < 3; ++axis) {
      own.velocity_sign[axis] = face.no_slip || axis == face.axis ? -1.0f : 1.0f;
    }
    if (face.no_slip) {
      own.velocity_offset = 2.0f * face.velocity;
      own.spin_sign = {-1, -1, -1};
    }
    // The velocity of an image of an image depends on which wall comes first where walls move: the mean of both.
    const auto mirrored = [&](Reflection r) {
      r.velocity_offset = 0.5f * (times(own.velocity_sign, r.velocity_offset) + own.velocity_offset +
                                  times(r.velocity_sign, own.velocity_offset) + r.velocity_offset);
      r.sign = times(r.sign, own.sign);
      r.offset += own.offset;
      r.velocity_sign = times(r.velocity_sign, own.velocity_sign);
      r.spin_sign = times(r.spin_sign, own.spin_sign);
      return r;
    };
    // With all images in faces of other axes, for edges and corners.
    for (int k = 0, before = number; k < before; ++k) {
      if (found[k].sign[face.axis] > 0) found[number++] = mirrored(found[k]);
    }
    found[number++] = own;
  }
  return number;
}

bool Walls::hold(Vec3& position, Vec3& velocity) const {
  bool held = false;
  for (const Face& face : faces_) {
    if (face.side * (position[face.axis] - face.plane) >= 0) continue;
    position[face.axis] = face.plane;
    if (face.side * velocity[face.axis] < 0) velocity[face.axis] = 0;
    held = true;
  }
  return held;
}

}  // namespace curlew
