// Reads back what particle_files.h writes: the frames of a finished run, to be drawn or meshed again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "sim/core/vec.h"

namespace curlew {

struct ParticleSet {
  std::optional<double> time;        // s; bgeo files do not say
  std::optional<std::int64_t> step;  // of the solver; bgeo files do not say
  std::vector<std::uint32_t> id;
  std::vector<Vec3> position, velocity;  // m, m/s
  std::vector<float> density;            // kg/m^3
};

// A .vtk, .ply or .bgeo file as this program writes them. Throws InputError, with the file and what is wrong in it, for
// any other.
ParticleSet read_particles(const std::filesystem::path& file);

}  // namespace curlew
