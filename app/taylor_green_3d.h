// The Taylor-Green vortex in 3D at Re 1600: its scene, and the course of its energy.
#pragma once

#include <vector>

#include "sim/core/world.h"

namespace curlew {

// u = (sin x cos y cos z, -cos x sin y cos z, 0) in a periodic box of (2 pi)^3, nu = 1 / 1600, across^3 particles.
Scene taylor_green_3d_scene(int across);

// Kinetic energy a mass, J/kg, over time.
struct EnergyCurve {
  std::vector<double> time, energy;

  void add(const World& world);

  // Between steps linear; NaN beyond the last.
  double at(double time) const;

  // -dE/dt, W/kg: the slope of the line that fits the times within width / 2 best, so that the steps' own noise does
  // not pass for dissipation; NaN where the curve does not reach that far.
  double loss(double time, double width) const;
  struct Loss {
    double time, rate;
  };
  Loss largest_loss(double width) const;
};

}  // namespace curlew
