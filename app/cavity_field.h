// What is measured in a cavity: the velocity at points of it, its mean over time, the stream function of that mean, and
// the vortices that it shows. The cavity is the unit square, its lid y = 1 moves along x with speed 1.
#pragma once

#include <string>
#include <vector>

#include "sim/core/world.h"

namespace curlew {

// The velocity (m/s) that the particles have at a point of a 2D world: a plane fitted to those within the support and
// to their reflections in the walls, weighted with the kernel (moving least squares, Lancaster & Salkauskas 1981). A
// no-slip wall has its own velocity to round-off.
Vec3d fitted_velocity(const World& world, Vec3d point);

// The mean of the velocity at fixed points, weighted with the time that each sample stands for.
class VelocityMean {
 public:
  explicit VelocityMean(std::vector<Vec3d> points) : points_(std::move(points)), sums_(points_.size()) {}

  void add(const World& world, double seconds);

  std::size_t size() const { return points_.size(); }
  Vec3d point(std::size_t k) const { return points_[k]; }
  Vec3d at(std::size_t k) const { return 1 / seconds_ * sums_[k]; }

 private:
  std::vector<Vec3d> points_, sums_;
  double seconds_ = 0;
};

// Values on the nodes (i / across, j / across), i fastest.
struct NodeField {
  std::size_t across = 0;
  std::vector<double> values;

  explicit NodeField(std::size_t n) : across(n), values((n + 1) * (n + 1)) {}
  double& at(std::size_t i, std::size_t j) { return values[j * (across + 1) + i]; }
  double at(std::size_t i, std::size_t j) const { return values[j * (across + 1) + i]; }
};

// psi with u = d psi / dy, v = -d psi / dx and psi = 0 on the walls, from lap psi = du/dy - dv/dx in central
// differences. The vortex that the lid drives has psi < 0, those in the corners psi > 0.
NodeField stream_function(const NodeField& u, const NodeField& v);

// An extremum of psi: the primary vortex (PV), and in the bottom right, bottom left and top left corners those that
// turn against it (BR1, BL1, TL1) and those that turn with it again (BR2, BL2, TL2). Of each the strongest.
struct CavityVortex {
  std::string name;
  double psi = 0, x = 0, y = 0;
};

// Those with |psi| of `least` and more; an extremum is higher than the 24 nodes around it.
std::vector<CavityVortex> cavity_vortices(const NodeField& psi, double least);

}  // namespace curlew
