// The walls of the domain, as exact integrals instead of samples: no wall has a list, a search or a bump.
//
// Behind a wall the fluid's lattice goes on in layers d apart. The first is the particle's own mirror image, so it lies
// 2a away where a is the particle's distance from the plane; the others stay where the lattice has them. Smearing each
// layer evenly over its plane gives the density that the wall adds,
//   lambda(a) = m / d^(D-1)  sum_n  I_(D-1)(s_n),     s_0 = 2a,  s_n = a + (n + 1/2) d,
// I_k(s): integral of W over a k-flat at distance s. Fluid on a lattice that touches the wall (a = d/2) has rest
// density to 0.03 % (0.16 % in 2D), and since the image moves against the particle, grad lambda carries the factor two
// that a mirrored pressure and a mirrored normal velocity have: with layers that stay put the wall pushes half as hard
// as fluid would, and the lowest layer has to creep up to the plane (0.19 d) before it is held. Where faces meet, the
// layers shared by two (an edge) or three (a corner) are counted once: subtract the I_(D-2), add the I_(D-3). No-slip:
// the layers move so that velocity vanishes at the plane, v_b = v_w - (s_b/a)(v - v_w) (Morris et al. 1997).
#pragma once

#include <vector>

#include "sim/scene/scene.h"
#include "sim/sph/kernel.h"

namespace curlew {

// A function of distance on [0, end), zero beyond: values and slopes on a fine grid, cubic in between, so that the
// slope that it returns is the derivative of the value that it returns.
class DistanceTable {
 public:
  template <class Value, class Slope>
  void fill(double end, Value&& value, Slope&& slope) {
    end_ = static_cast<float>(end);
    const double step = end / intervals;
    inverse_step_ = static_cast<float>(1 / step);
    nodes_.clear();
    for (int k = 0; k <= intervals; ++k) {
      nodes_.push_back({static_cast<float>(value(k * step)), static_cast<float>(slope(k * step) * step)});
    }
  }

  struct Sample {
    float value, slope;
  };
  Sample at(float distance) const {
    if (!(distance < end_)) return {0, 0};
    const float scaled = distance * inverse_step_;
    const auto k = static_cast<std::size_t>(scaled);
    const float t = scaled - static_cast<float>(k);
    const auto [f0, g0] = nodes_[k];
    const auto [f1, g1] = nodes_[k + 1];
    const float c = 3 * (f1 - f0) - 2 * g0 - g1, e = 2 * (f0 - f1) + g0 + g1;
    return {f0 + t * (g0 + t * (c + t * e)), (g0 + t * (2 * c + 3 * e * t)) * inverse_step_};
  }

 private:
  static constexpr int intervals = 512;
  float end_ = 0, inverse_step_ = 0;
  std::vector<Sample> nodes_;
};

// What the walls do to a particle at one place, as in the fields boundary_gradient, boundary_friction and
// no_slip_gradient.
struct WallSum {
  Vec3 gradient;  // w: density
  Vec3 virial;    // -gradient times the distance from the plane, axis by axis; walls only
  Vec3 friction;
  Vec3 no_slip_gradient;  // bodies only: walls reflect
  float neighbours = 0;   // lattice points that would lie in the support behind the walls
};

// The fluid seen in a wall, or in two or three that meet: a neighbour at x_ij appears at sign x_ij + offset with the
// velocity velocity_sign v + velocity_offset and the spin spin_sign omega (all component by component). A slip wall
// turns the velocity across it and leaves spins alone: it exerts no torque on them. (As a mirror of vorticity it would
// turn spins along it, and the jump would drive jets along every wall: with nu_t = 0.2 the hemisphere scene then gained
// 280 times the kinetic energy of plain DFSPH.) In a no-slip wall the whole velocity is turned around the wall's, and
// the whole spin around none (Bender et al. 2018, section 7).
struct Reflection {
  Vec3 sign{1, 1, 1}, offset;
  Vec3 velocity_sign{1, 1, 1}, velocity_offset;
  Vec3 spin_sign{1, 1, 1};
};

class Walls {
 public:
  Walls() = default;
  // mass in kg, spacing in m.
  Walls(const Domain& domain, int dimension, const Kernel& kernel, double spacing, double mass);

  bool any() const { return !faces_.empty(); }
  bool any_no_slip() const;
  WallSum sum(Vec3 position) const;

  // The reflections in which a particle at `position` has neighbours; returns their number, most_reflections at most.
  int reflections(Vec3 position, Reflection* found) const;
  static constexpr int most_reflections = 26;

  // A droplet too thin to feel the wall's pressure may reach the plane: it is held there and loses the velocity into
  // the wall. Returns whether it was.
  bool hold(Vec3& position, Vec3& velocity) const;

 private:
  struct Face {
    int axis;
    float side;   // +1: fluid lies on the side of larger coordinates
    float plane;  // m
    bool no_slip;
    Vec3 velocity;
  };
  struct Near {
    const Face* face;
    float distance;
  };
  static constexpr int most_near = 6;
  struct Layer {
    float distance, rate;
  };

  Layer layer(int number, float distance) const;
  void add_face(WallSum& total, const Near& near) const;
  void add_overlap(WallSum& total, const Near* const* near, int number) const;
  float lattice_points(float distance) const;

  std::vector<Face> faces_;
  DistanceTable flat_[3];   // I_k, multiplied by m / d^k
  DistanceTable friction_;  // integral of 2 r |W'| / (r^2 + 0.01 h^2) over a (D-1)-flat, multiplied by d
  int dimension_ = 3;
  float spacing_ = 0, support_ = 0;
  int layers_ = 0;  // that can lie within the support
};

}  // namespace curlew
