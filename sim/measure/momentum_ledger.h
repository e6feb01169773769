// Who changes momentum: linear P = sum m v, orbital L = sum m x x v, spin S = Theta sum m omega, pass by pass.
//
// The micropolar model (Bender et al. 2018, Eq. 6, 7; c = nu_t, or nu + nu_t) does not keep L + S even on paper:
//   dS/dt = c int rho (curl v - 2 omega) dV          diffusion and XSPH of omega are symmetric and add nothing
//   dL/dt = c int rho x x curl omega dV = 2 c int rho omega dV + c rho surface int x x (n x omega) dA
//   d(L + S)/dt = c int rho curl v dV + the surface term
// A surface free of traction has no surface term. What is left is the torque c int rho curl v dV: the model lacks the
// force that answers it, nu_t/2 lap v with its traction on the surface (the antisymmetric stress of a micropolar fluid
// is proportional to curl v / 2 - omega, Eringen 1966; the model has the couple of both parts but the force of omega
// only). The difference form of curl omega sees no surface, so the surface term is there too: where omega is uniform it
// is -2 c int rho omega dV and dL/dt = 0.
#pragma once

#include <map>
#include <string>

#include "sim/core/passes.h"

namespace curlew {

struct Momenta {
  Vec3d linear;         // kg m/s
  Vec3d orbital, spin;  // kg m^2/s, about the origin
};

Momenta momenta(const World& world);

// sum m |v|, kg m/s: what a drift of linear momentum is to be measured against.
double absolute_momentum_sum(const World& world);

// Give it to step(); sums what each pass changed since it was made.
struct MomentumLedger : PassObserver {
  explicit MomentumLedger(const World& world) : last(momenta(world)) {}

  void after(const Pass& pass, const World& world, double milliseconds) override;

  // What a pass changed; nothing for one that did not run.
  Momenta by(const std::string& pass) const;

  Momenta last;
  std::map<std::string, Momenta> changes;
  // Of the micropolar model, over time: c int rho curl v dV dt and 2 c int rho omega dV dt, kg m^2/s.
  Vec3d curl_torque, spin_torque;
};

}  // namespace curlew
