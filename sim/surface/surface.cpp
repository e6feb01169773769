#include "sim/surface/surface.h"

#include <chrono>
#include <cmath>
#include <numbers>

#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/surface/vertex_velocity.h"

namespace curlew {
namespace {

// Peak of a source's kernel, such that the kernel's integral is the volume of a particle: 315 / (64 pi R^3) d^3.
double full_weight(double radius_over_spacing) {
  return 315 / (64 * std::numbers::pi * std::pow(radius_over_spacing, 3));
}

// By how much the kernel of a lone particle is to be raised, so that its drop has the particle's volume: phi is to
// cross iso at the radius of a ball of that volume.
double lone_factor(double radius_over_spacing, double iso) {
  const double ball = std::cbrt(3 / (4 * std::numbers::pi)), q = ball / radius_over_spacing;
  return std::max(1.0, iso / (full_weight(radius_over_spacing) * std::pow(1 - q * q, 3)));
}

template <class F>
double milliseconds(F&& f) {
  const auto begin = std::chrono::steady_clock::now();
  f();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

// The particles with the peaks of their kernels.
void SurfaceMaker::make_sources(const SurfaceParticles& particles, const Scene& scene) {
  const SurfaceParameters& p = scene.parameters.surface;
  const double d = scene.spacing();
  // How crowded a particle is: 0 alone, 1 in the midst of water. Sprays lose their neighbours' share of phi, which is
  // made up for.
  const Kernel kernel(d * scene.parameters.sph.h_over_d, 3, static_cast<KernelKind>(scene.parameters.sph.kernel));
  const double alone = kernel.value(0) / kernel.lattice_sum(d);
  const double weight = full_weight(p.kernel_radius), lone = lone_factor(p.kernel_radius, p.iso);
  constexpr double enough = 0.6;  // a particle in a flat surface has more
  sources_.resize(particles.position.size());
  parallel_for(sources_.size(), [&](std::size_t i) {
    sources_[i] = particles.position[i];
    double factor = 1;
    if (!particles.density.empty()) {
      const double share = static_cast<double>(particles.density[i]) / scene.parameters.sph.rest_density;
      const double missing = std::clamp(1 - (share - alone) / (enough * (1 - alone)), 0.0, 1.0);
      factor = 1 + (lone - 1) * missing * missing;
    }
    sources_[i].w = static_cast<float>(factor * weight);
  });
}

const SurfaceMesh& SurfaceMaker::make(const SurfaceParticles& particles, const Scene& scene) {
  const SurfaceParameters& p = scene.parameters.surface;
  const double d = scene.spacing(), cell = p.cell * scene.particle_radius, radius = p.kernel_radius * d;
  if (radius > LevelSet::side * cell) {
    throw InputError("surface.kernel_radius is " + number_text(p.kernel_radius) + ", expected at most " +
                     number_text(LevelSet::side * cell / d) + " with surface.cell " + number_text(p.cell));
  }
  make_sources(particles, scene);
  const bool splits = !particles.sub_particles.empty();
  times_.level_set = milliseconds([&] {
    shapes_.assign(1, round_shape(radius));
    if (splits) {
      sub_sources_.split(
          sources_, {particles.position, particles.id, particles.sub_particles, particles.time, scene.particle_radius});
      for (int level = 1; level <= most_sub_levels; ++level)
        shapes_.push_back(round_shape(sub_particle_share(level) * radius));
      level_set_.build({sub_sources_.sources(), shapes_, sub_sources_.kind(), d}, scene.domain, cell, p.iso);
      return;
    }
    sub_sources_ = {};
    if (p.anisotropic) shape_finder_.run(sources_, scene.domain, d, radius, shapes_);
    level_set_.build({sources_, shapes_, {}, d}, scene.domain, cell, p.iso);
  });
  const auto normals = p.smoothing > 0 ? Polygoniser::Normals::straight : Polygoniser::Normals::gradient;
  times_.polygonise = milliseconds([&] { polygoniser_.run(level_set_, normals, mesh_); });
  times_.smooth = milliseconds([&] { smoother_.run(mesh_, p.smoothing, scene.domain); });
  mesh_.velocity.clear();
  if (particles.velocity.empty()) return mesh_;
  const auto velocity = splits ? sub_sources_.of_sources(particles.velocity) : particles.velocity;
  find_vertex_velocities(level_set_, polygoniser_, velocity, mesh_);
  return mesh_;
}

std::size_t SurfaceMaker::bytes() const {
  return sources_.capacity() * sizeof(Vec3) + shapes_.capacity() * sizeof(SourceShape) + shape_finder_.bytes() +
         sub_sources_.bytes() + level_set_.bytes() + polygoniser_.bytes() + smoother_.bytes() +
         mesh_.position.capacity() * 2 * sizeof(Vec3) + mesh_.triangles.capacity() * 12;
}

}  // namespace curlew
