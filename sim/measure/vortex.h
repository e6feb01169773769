// How well a run keeps a flow whose exact solution is known and steady: profiles, errors, amplitudes, and what the
// micropolar model is to add on paper.
#pragma once

#include <vector>

#include "sim/core/world.h"

namespace curlew {

// The mean speed (m/s) around the field's centre of the particles in a ring, and the mean of what the field has at
// those same places, so that the ring's width favours neither.
struct ProfileRing {
  double radius = 0;  // m, mean of the particles
  double measured = 0, exact = 0;
  int particles = 0;
};

// Rings of that width (m) from the centre out to `reach` (m), empty ones left out.
std::vector<ProfileRing> azimuthal_profile(const World& world, const InitialVelocity& exact, double width,
                                           double reach);

// Largest measured over largest exact speed.
double peak_retained(const std::vector<ProfileRing>& profile);

// sum |v - v_exact| / sum |v_exact| over the particles within `reach` (m) of `centre`.
double velocity_error(const World& world, const InitialVelocity& exact, Vec3d centre, double reach);

// sum v . v_exact / sum |v_exact|^2: how much of that flow is there, whatever else is.
double flow_amplitude(const World& world, const InitialVelocity& exact);

// sqrt(sum V |curl v|^2 / sum V |v|^2), 1/m, with the curl as the solver sees it: of a shear wave or Taylor vortex its
// wave number; of any flow the k with which the inviscid micropolar model raises its kinetic energy, to second order in
// time. Needs the fields vorticity and density.
double wave_number(const World& world);

// A wave k under the inviscid micropolar model (Bender et al. 2018, Eq. 8, 9): V' = nu_t k W, Theta W' = nu_t (k V - 2
// W). Its rate of growth, 1/s, and V(t) / V(0) where the spin W begins at zero.
double micropolar_growth_rate(const MicropolarParameters& p, double k);
double micropolar_growth(const MicropolarParameters& p, double k, double time);

}  // namespace curlew
