#include "sim/core/world.h"

#include <cmath>

#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"

namespace curlew {

World make_empty_world(const Scene& scene, std::uint64_t seed) {
  World world;
  world.scene = scene;
  world.seed = seed;
  const double d = scene.spacing(), h = d * scene.parameters.sph.h_over_d;
  world.kernel = Kernel(h, scene.dimension, static_cast<KernelKind>(scene.parameters.sph.kernel));
  // A lattice has exactly rest density, whatever the kernel's lattice sum.
  const double mass = scene.parameters.sph.rest_density / world.kernel.lattice_sum(d);
  world.mass = static_cast<float>(mass);
  world.cells = make_cell_shape(scene.domain, scene.dimension, world.kernel.support());
  world.walls = Walls(scene.domain, scene.dimension, world.kernel, d, mass);
  world.bodies = BodySamples(scene, world.cells, world.kernel);
  world.obstacles = std::make_shared<const Obstacles>(scene);
  world.body_places = body_places(scene.bodies, 0);
  return world;
}

World make_world(const Scene& scene, std::uint64_t seed) {
  check_resolution(scene);
  World world = make_empty_world(scene, seed);
  const ParticleSample sample = sample_fluid(scene);
  world.count = sample.position.size();
  Fields& f = world.fields;
  for (std::size_t i = 0; i < world.count; ++i) {
    f.position.push_back(to_float(sample.position[i]));
    f.velocity.push_back(to_float(sample.velocity[i]));
    f.id.push_back(static_cast<std::uint32_t>(i));
  }
  f.density_stiffness.resize(world.count);
  f.divergence_stiffness.resize(world.count);
  return world;
}

std::size_t allocated_bytes(const World& world) {
  std::size_t bytes = world.neighbours.bytes() + world.grid.bytes() + world.bodies.bytes() + world.potential.bytes();
  const auto add = [&](const FieldRow&, const auto& array) { bytes += array.capacity() * sizeof(array[0]); };
  for_each_field(world.fields, add);
  for_each_field(world.sort_space, add);
  bytes += world.order.capacity() * sizeof(std::uint32_t);
  for (const Array<Vec3>* saved :
       {&world.backup.velocity, &world.backup.microrotation, &world.backup.predicted_vorticity}) {
    bytes += saved->capacity() * sizeof(Vec3);
  }
  bytes += (world.backup.density_stiffness.capacity() + world.backup.divergence_stiffness.capacity()) * sizeof(float);
  return bytes;
}

}  // namespace curlew
