// The lid-driven cavity as others have computed it on fine grids: the unit square, its lid y = 1 moving along x with
// speed 1. The velocities on the centre lines, and the extrema of the stream function.
#pragma once

#include <span>
#include <string>

namespace curlew {

struct ProfilePoint {
  double at, velocity;
};

struct ReferenceVortex {
  const char* name;  // as CavityVortex has it
  double psi, x, y;
};

struct CavityReference {
  int reynolds = 0;
  const char *profile_source = "", *vortex_source = "";
  std::span<const ProfilePoint> u, v;  // u(0.5, y) and v(x, 0.5), without the walls
  std::span<const ReferenceVortex> vortices;
};

// Re 100, 1000 and 10000.
std::span<const CavityReference> cavity_references();

}  // namespace curlew
