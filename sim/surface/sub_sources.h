// Vortex sub-particles as sources of the surface (Fujisawa et al. 2011, Eq. 12 to 14): a particle of level L stands for
// 2^L kernels of the radius of its level; between two levels both are there, weighted. All kernels have the same peak,
// so the integral of phi does not depend on the level.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/vec.h"
#include "sim/turbulence/sub_particles_fujisawa2011.h"

namespace curlew {

class SubSources {
 public:
  // `whole` are the particles with their peaks in w, as many as in `state`.
  void split(std::span<const Vec3> whole, const SubParticleState& state);

  std::span<const Vec3> sources() const { return source_; }
  std::span<const std::uint8_t> kind() const { return kind_; }  // the level
  // The velocities of the sources, from those of the particles.
  std::span<const Vec3> of_sources(std::span<const Vec3> velocity);
  std::size_t bytes() const;

 private:
  std::vector<Vec3> source_, velocity_;
  std::vector<std::uint8_t> kind_;
  std::vector<std::uint32_t> first_;  // of a particle's sources
};

}  // namespace curlew
