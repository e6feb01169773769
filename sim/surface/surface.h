// From particles to the mesh of the water's surface: sources, level set, marching cubes, smoothing. Keeps its memory
// from one frame to the next.
#pragma once

#include <span>
#include <vector>

#include "sim/core/params.h"
#include "sim/core/vec.h"
#include "sim/scene/scene.h"
#include "sim/sph/kernel.h"
#include "sim/surface/anisotropy.h"
#include "sim/surface/level_set.h"
#include "sim/surface/polygonise.h"
#include "sim/surface/smoothing.h"
#include "sim/surface/sub_sources.h"

namespace curlew {

// The particles of one moment. The arrays stay the caller's; all have the same length, but for those left empty.
struct SurfaceParticles {
  std::span<const Vec3> position;       // m
  std::span<const float> density;       // kg/m^3, boundaries included; empty: particles count as deep in the water
  std::span<const Vec3> velocity = {};  // m/s; where given, the vertices get theirs
  // Where given, particles that have split are shown by their vortex sub-particles.
  std::span<const Vec3> sub_particles = {};  // the field
  std::span<const std::uint32_t> id = {};
  double time = 0;  // s
};

class SurfaceMaker {
 public:
  // The mesh of the water in a scene of three dimensions; valid until the next call. Throws InputError where the
  // surface's parameters contradict each other.
  const SurfaceMesh& make(const SurfaceParticles& particles, const Scene& scene);

  const SurfaceMesh& mesh() const { return mesh_; }

  // Milliseconds of the last call.
  struct Times {
    double level_set = 0, polygonise = 0, smooth = 0;
  };
  const Times& times() const { return times_; }
  std::size_t bytes() const;

 private:
  void make_sources(const SurfaceParticles& particles, const Scene& scene);

  std::vector<Vec3> sources_;
  SubSources sub_sources_;  // empty without sub-particles
  std::vector<SourceShape> shapes_;
  ShapeFinder shape_finder_;  // empty unless surface.anisotropic
  LevelSet level_set_;
  Polygoniser polygoniser_;
  Smoother smoother_;
  SurfaceMesh mesh_;
  Times times_;
};

}  // namespace curlew
