// Clouds of particles and the surfaces made of them, for tests.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "sim/surface/surface.h"
#include "tests/unit/surface_checks.h"

namespace curlew::test {

inline Scene scene_with(double radius = 0.02) {
  Scene scene;
  scene.particle_radius = radius;
  scene.domain.min = {-1, -1, -1};
  scene.domain.max = {1, 1, 1};
  return scene;
}

using Inside = std::function<bool(Vec3d)>;

// Particles on a lattice, each moved by up to `jitter` spacings along each axis, where `inside` holds.
inline std::vector<Vec3> lattice(const Scene& scene, const Inside& inside, double jitter = 0.2) {
  const double d = scene.spacing();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> move(-jitter * d, jitter * d);
  std::vector<Vec3> particles;
  const int n = static_cast<int>(std::round(1 / d));
  for (int i = -n; i < n; ++i) {
    for (int j = -n; j < n; ++j) {
      for (int k = -n; k < n; ++k) {
        const Vec3d p{(i + 0.5) * d, (j + 0.5) * d, (k + 0.5) * d};
        if (inside(p)) particles.push_back(to_float(p + Vec3d{move(random), move(random), move(random)}));
      }
    }
  }
  return particles;
}

inline Inside ball(double radius, Vec3d centre = {}) {
  return [=](Vec3d p) { return length(p - centre) < radius; };
}
inline Inside box(Vec3d low, Vec3d high) {
  return [=](Vec3d p) {
    return p.x > low.x && p.y > low.y && p.z > low.z && p.x < high.x && p.y < high.y && p.z < high.z;
  };
}

// Density of each particle relative to 1000 kg/m^3, by brute force over a sorted copy: small clouds only.
inline std::vector<float> densities(const Scene& scene, const std::vector<Vec3>& particles) {
  const double d = scene.spacing();
  const Kernel kernel(d, 3);
  std::vector<float> density;
  for (const Vec3& p : particles) {
    double sum = 0;
    for (const Vec3& q : particles) sum += kernel.value(static_cast<double>(length(p - q)));
    density.push_back(static_cast<float>(1000 * sum / kernel.lattice_sum(d)));
  }
  return density;
}

inline SurfaceMesh surface(const Scene& scene, const std::vector<Vec3>& particles,
                           const std::vector<float>& density = {}) {
  SurfaceMaker maker;
  return maker.make({particles, density}, scene);
}

inline void check_closed(const SurfaceMesh& mesh, const Scene& scene) {
  REQUIRE_FALSE(mesh.empty());
  CHECK(unpaired_sides(mesh) == 0);
  CHECK(pinched_vertices(mesh) == 0);
  CHECK(enclosed_volume(mesh) > 0);
  const double cell = scene.parameters.surface.cell * scene.particle_radius;
  CHECK(outward_normals(mesh, 0.05 * cell * cell) > 0.95);
}

}  // namespace curlew::test
