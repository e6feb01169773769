#include "sim/surface/sub_sources.h"

#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"

namespace curlew {
namespace {

// The two levels that a particle lies between, and the share of the upper one.
struct Blend {
  int low;
  float share;
  explicit Blend(float level) : low(static_cast<int>(level)), share(level - static_cast<float>(low)) {}
  std::uint32_t number() const { return (1u << low) + (share > 0 ? 2u << low : 0u); }
};

}  // namespace

void SubSources::split(std::span<const Vec3> whole, const SubParticleState& state) {
  const std::size_t n = whole.size();
  first_.resize(n + 1);
  first_[0] = 0;
  for (std::size_t i = 0; i < n; ++i)
    first_[i + 1] = first_[i] + Blend(sub_particle_level_of(state.sub_particles[i])).number();
  source_.resize(first_[n]);
  kind_.resize(first_[n]);
  parallel_for(n, [&](std::size_t i) {
    const Blend blend(sub_particle_level_of(state.sub_particles[i]));
    std::uint32_t at = first_[i];
    std::array<Vec3, most_sub_particles> places;
    const auto add = [&](int level, float share) {
      for (const Vec3& place :
           place_sub_particles(state.id[i], level, state.sub_particles[i], state.time, state.radius, places)) {
        source_[at] = whole[i] + place;
        source_[at].w = share * whole[i].w;
        kind_[at++] = static_cast<std::uint8_t>(level);
      }
    };
    add(blend.low, 1 - blend.share);
    if (blend.share > 0) add(blend.low + 1, blend.share);
  });
}

std::span<const Vec3> SubSources::of_sources(std::span<const Vec3> velocity) {
  velocity_.resize(source_.size());
  parallel_for(velocity.size(), [&](std::size_t i) {
    std::fill(velocity_.begin() + first_[i], velocity_.begin() + first_[i + 1], velocity[i]);
  });
  return velocity_;
}

std::size_t SubSources::bytes() const {
  return (source_.capacity() + velocity_.capacity()) * sizeof(Vec3) + kind_.capacity() +
         first_.capacity() * sizeof(std::uint32_t);
}

}  // namespace curlew
