// Sums over the neighbours of one particle, eight at a time.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// One visit of all pairs, for the work counts.
inline void count_sweep(World& world) {
  ++world.work.sweeps;
  world.work.pair_visits += world.neighbours.pairs();
}

struct VectorSum {
  f8 x{}, y{}, z{};

  // slope (a_i - a_j) x x_ij: times the volume of j, the curl of a in the difference form (Liu et al. 2020, Eq. 6).
  void add_curl(f8 slope, Vec3 here, const Vec8& there, const Pairs& pairs) {
    const f8 ax = here.x - there.x, ay = here.y - there.y, az = here.z - there.z;
    x += slope * (ay * pairs.z - az * pairs.y);
    y += slope * (az * pairs.x - ax * pairs.z);
    z += slope * (ax * pairs.y - ay * pairs.x);
  }

  // -slope (a_i + a_j) x x_ij. With a = A / rho^2, and times rho_i and the mass, this is the curl of A in the symmetric
  // form, -rho_i sum m (A_i / rho_i^2 + A_j / rho_j^2) x grad W (Monaghan 1992, section 2; Bender et al. 2018, Fig. 2).
  // With a = A / rho, and times the mass alone, it is the adjoint of the difference form above: sum m A . curl v =
  // sum m v . adjoint(A) for any v. Pairs cancel either way, so such a force keeps linear momentum; but it is no
  // derivative where neighbours are missing (error -21 on a curl of 2 at a free surface, where the difference form has
  // -0.8).
  void add_curl_symmetric(f8 slope, Vec3 here, const Vec8& there, const Pairs& pairs) {
    const f8 ax = here.x + there.x, ay = here.y + there.y, az = here.z + there.z;
    x -= slope * (ay * pairs.z - az * pairs.y);
    y -= slope * (az * pairs.x - ax * pairs.z);
    z -= slope * (ax * pairs.y - ay * pairs.x);
  }

  void add(f8 ax, f8 ay, f8 az) {
    x += ax;
    y += ay;
    z += az;
  }

  Vec3 total() const { return {sum(x), sum(y), sum(z)}; }
};

}  // namespace curlew
