#include "sim/turbulence/sub_particles_fujisawa2011.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/parallel.h"

namespace curlew {
namespace {

// Density over rest density, boundaries included, from which on a particle counts as deep in the water: the second
// layer below a surface still has less.
constexpr float deep = 0.985f;

// A number that looks random, from 64 bits that need not (the finaliser of MurmurHash3 as improved by Stafford 2011).
std::uint64_t mixed(std::uint64_t v) {
  v = (v ^ v >> 30) * 0xbf58476d1ce4e5b9u;
  v = (v ^ v >> 27) * 0x94d049bb133111ebu;
  return v ^ v >> 31;
}

struct Quaternion {
  float w;
  Vec3 v;

  friend Quaternion operator*(const Quaternion& p, const Quaternion& q) {
    return {p.w * q.w - dot(p.v, q.v), p.w * q.v + q.w * p.v + cross(p.v, q.v)};
  }
  Vec3 turned(Vec3 a) const {
    const Vec3 t = 2.0f * cross(v, a);
    return a + w * t + cross(v, t);
  }
};

// 0 to 1, from 16 bits.
float share_of(std::uint64_t bits) { return (static_cast<float>(bits & 0xffff) + 0.5f) / 65536.0f; }

// Any attitude is as likely as any other (Shoemake 1992, "Uniform random rotations").
Quaternion random_attitude(std::uint64_t bits) {
  constexpr auto circle = static_cast<float>(2 * std::numbers::pi);
  const float u = share_of(bits), v = circle * share_of(bits >> 16), w = circle * share_of(bits >> 32);
  const float a = std::sqrt(1 - u), b = std::sqrt(u);
  return {a * std::sin(v), {a * std::cos(v), b * std::sin(w), b * std::cos(w)}};
}

}  // namespace

double sub_particle_share(int level) { return std::exp2(-level / 3.0); }

float sub_particle_level(float energy, float critical, int levels) {
  if (!(energy > critical)) return 0;
  return std::min(static_cast<float>(levels), 1.8f * std::log2(energy / critical));
}

float sub_particle_turn(float energy, int level, double radius, double dt) {
  const double speed = std::sqrt(2 * static_cast<double>(energy) * std::exp2(-5.0 / 9 * level));
  return static_cast<float>(speed * dt / (sub_particle_share(level + 1) * radius) / (2 * std::numbers::pi));
}

float next_turn(float turn, float by) {
  const float next = turn + by;
  return next - std::floor(next);
}

SubPair sub_pair(std::uint32_t particle, int level, std::uint32_t number, float turn, double time) {
  // A random attitude, which itself turns slowly about a random direction: a quarter to three quarters of a turn a
  // second.
  const std::uint64_t seed = mixed(std::uint64_t{particle} << 8 | static_cast<unsigned>(level) << 4 | number);
  const std::uint64_t more = mixed(seed);
  const Quaternion attitude = random_attitude(seed), direction = random_attitude(more);
  const double turns = time * (0.25 + 0.5 * static_cast<double>(share_of(more >> 48)));
  const auto half = static_cast<float>(std::numbers::pi * (turns - std::floor(turns)));
  const Quaternion drift{std::cos(half), std::sin(half) * direction.turned({0, 0, 1})};
  const Quaternion now = drift * attitude;
  const float angle = static_cast<float>(2 * std::numbers::pi) * turn;
  return {now.turned({0, 0, 1}), now.turned({std::cos(angle), std::sin(angle), 0})};
}

std::span<const Vec3> place_sub_particles(std::uint32_t particle, int level, Vec3 turns, double time, double radius,
                                          std::array<Vec3, most_sub_particles>& places) {
  places[0] = {};
  for (int l = 0; l < level; ++l) {
    const auto arm = static_cast<float>(sub_particle_share(l + 1) * radius);
    for (std::uint32_t j = 1u << l; j-- > 0;) {
      const Vec3 c = arm * sub_pair(particle, l, j, turns[l], time).arm, middle = places[j];
      places[2 * j] = middle + c;
      places[2 * j + 1] = middle - c;
    }
  }
  return {places.data(), std::size_t{1} << level};
}

SplitParticles split_particles(const SubParticleState& state) {
  const std::size_t n = state.position.size();
  const auto level_of = [&](std::size_t i) {
    return static_cast<int>(std::lround(sub_particle_level_of(state.sub_particles[i])));
  };
  std::vector<std::size_t> first(n + 1);
  for (std::size_t i = 0; i < n; ++i) first[i + 1] = first[i] + (std::size_t{1} << level_of(i));
  SplitParticles split;
  split.position.resize(first[n]);
  split.share.resize(first[n]);
  split.parent.resize(first[n]);
  parallel_for(n, [&](std::size_t i) {
    std::array<Vec3, most_sub_particles> places;
    const int level = level_of(i);
    const auto parts =
        place_sub_particles(state.id[i], level, state.sub_particles[i], state.time, state.radius, places);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      split.position[first[i] + k] = state.position[i] + parts[k];
      split.share[first[i] + k] = static_cast<float>(sub_particle_share(level));
      split.parent[first[i] + k] = static_cast<std::uint32_t>(i);
    }
  });
  return split;
}

void advance_sub_particles(World& world) {
  Fields& f = world.fields;
  const SubParticleParameters& p = world.parameters().sub_particles;
  const auto critical = static_cast<float>(p.critical_energy);
  const float dense = deep * world.rest_density();
  const auto rise = static_cast<float>(1 - std::exp(-world.dt / p.rise)),
             decay = static_cast<float>(1 - std::exp(-world.dt / p.decay));
  std::array<float, most_sub_levels> turn_of_unit;  // at an energy of 1 m^2/s^2; it goes with the root
  for (int level = 0; level < most_sub_levels; ++level)
    turn_of_unit[static_cast<std::size_t>(level)] = sub_particle_turn(1, level, world.scene.particle_radius, world.dt);
  parallel_for(world.count, [&](std::size_t i) {
    Vec3& state = f.sub_particles[i];
    const float energy = f.wavelet_energy[i];
    const float wanted = f.density[i] < dense ? sub_particle_level(energy, critical, p.levels) : 0;
    state.w += (wanted > state.w ? rise : decay) * (wanted - state.w);
    if (state.w < 1e-3f) state.w = 0;
    for (int level = 0; level < most_sub_levels; ++level) {
      state[level] = next_turn(state[level], std::sqrt(energy) * turn_of_unit[static_cast<std::size_t>(level)]);
    }
  });
}

}  // namespace curlew
