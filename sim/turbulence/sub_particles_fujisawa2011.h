// Vortex sub-particles: eddies smaller than a particle, as a tree of ever smaller parts of it that circle each other
// (Fujisawa et al. 2011, section 3.4). A particle of level L is 2^L sub-particles of radius r_L = 2^(-L/3) r_0; the two
// that a sub-particle of level L splits into stand opposite each other at +-r_(L+1) c from its middle and turn about an
// axis a, perpendicular to the unit vector c, by |u^_L| dt / r_(L+1) in a step (Eq. 11), with
//   |u^_L| = sqrt(2 e^ (2^(-5/9))^L)                                                        (Eq. 10).
// They follow the flow and never act on it.
//
// All pairs of a level turn at the same pace, so a particle carries one angle a level and its level. Which way a pair
// lies follows from these, its number and the time alone: |c| = 1 and a . c = 0 hold however long a run is.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/world.h"

namespace curlew {

inline constexpr int most_sub_levels = 3;
inline constexpr std::size_t most_sub_particles = 1u << most_sub_levels;

// r_L / r_0.
double sub_particle_share(int level);

// The level L at which e^ (2^(-5/9))^L has come down to the critical energy (Eq. 13), 0 to `levels`.
float sub_particle_level(float energy, float critical, int levels);

// The level in the field, 0 to most_sub_levels whatever a file has put there.
inline float sub_particle_level_of(Vec3 state) {
  return state.w > 0 ? std::min(state.w, static_cast<float>(most_sub_levels)) : 0;
}

// Turns, of the full circle, in a time dt of the pairs that split a sub-particle of `level`, for a particle of radius
// r_0 (m) and wavelet energy e^ (m^2/s^2).
float sub_particle_turn(float energy, int level, double radius, double dt);

// An angle in turns, 0 to 1, moved on.
float next_turn(float turn, float by);

// What a pass carries for a particle: x, y, z the angles of the pairs on level 0, 1, 2 in turns, 0 to 1; w the level.
// Axis and arm of a pair.
struct SubPair {
  Vec3 axis, arm;  // a and c
};
SubPair sub_pair(std::uint32_t particle, int level, std::uint32_t number, float turn, double time);

// Fills in the places of the 2^level sub-particles of a level, m from the middle of their particle.
std::span<const Vec3> place_sub_particles(std::uint32_t particle, int level, Vec3 turns, double time, double radius,
                                          std::array<Vec3, most_sub_particles>& places);

// Particles of a moment, each of its nearest level. The arrays stay the caller's.
struct SubParticleState {
  std::span<const Vec3> position;  // m
  std::span<const std::uint32_t> id;
  std::span<const Vec3> sub_particles;  // the field
  double time = 0, radius = 0;          // s; r_0, m
};
struct SplitParticles {
  std::vector<Vec3> position;
  std::vector<float> share;           // of r_0
  std::vector<std::uint32_t> parent;  // places in SubParticleState
};
// Sub-particles in place of particles that have split, in the particles' order.
SplitParticles split_particles(const SubParticleState& state);

// The pass: levels follow the wavelet energy of particles near the surface, up within sub_particles.rise and down
// within sub_particles.decay, and angles go on.
void advance_sub_particles(World& world);

}  // namespace curlew
