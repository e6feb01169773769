// From shapes to points: fluid particles on lattices, body surfaces as one even layer of samples. Deterministic: the
// same scene gives the same points in the same order, bit for bit. Lengths in metres.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/scene/scene.h"

namespace curlew {

struct ParticleSample {
  std::vector<Vec3d> position;  // m
  std::vector<Vec3d> velocity;  // m/s
};

// The scene's fluid as particles on cubic lattices with the scene's spacing d = 2r. A lattice begins r inside the
// domain's minimum, or r inside the shape's own minimum for boxes and heightfields, so that walls are at distance r and
// boxes fill evenly. Left out are points outside the domain or nearer than r to a wall or a body, and points nearer
// than 0.7 d to a particle of an earlier fluid. Ordered by fluid, then by x, y and z. Throws InputError as
// check_resolution does, and where a fluid holds no particle.
ParticleSample sample_fluid(const Scene&);

// How many particles sample_fluid returns, without storing them where there is only one fluid.
std::int64_t count_particles(const Scene&);

// The velocity (m/s) that an initial field has at p.
Vec3d initial_velocity(const InitialVelocity&, Vec3d p, const Scene&);

// The speed (m/s) around z that rotation, gresho_chan and lamb_oseen have at a distance r (m) from their centre.
double azimuthal_speed(const InitialVelocity&, double r);

// One even layer of points on the shape's surface, in 2D its outline: about `spacing` apart, never nearer than 0.6 of
// it, and no place of the surface farther than about 0.85 of it from a sample. Points beyond the domain by more than
// two spacings are left out, and in periodic axes all beyond it.
std::vector<Vec3d> sample_surface(const Shape&, double spacing, int dimension, const Domain&);

// The samples of a body: two such layers, half a spacing and 3/2 spacings beneath the surface, where it is thick enough
// for them; a thin part has one in its middle. Fluid keeps about a spacing from the first, so that it stands half a
// spacing off the surface, as it does off a wall.
std::vector<Vec3d> sample_body(const Shape&, double spacing, int dimension, const Domain&);

}  // namespace curlew
