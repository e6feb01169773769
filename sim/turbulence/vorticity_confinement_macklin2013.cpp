#include "sim/turbulence/vorticity_confinement_macklin2013.h"

#include <cmath>

#include "sim/core/parallel.h"
#include "sim/sph/pair_sums.h"
#include "sim/turbulence/energy_guard.h"

namespace curlew {

void vorticity_confinement(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const auto epsilon = static_cast<float>(world.parameters().vorticity_confinement.epsilon);
  // |omega| once a particle, in w of what it is the length of.
  parallel_for(world.count, [&](std::size_t i) { f.vorticity[i].w = length(f.vorticity[i]); });
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 omega = f.vorticity[i];
      VectorSum rise;
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        const f8 step = world.kernel.slope(p.r2) * (gather(f.vorticity.data(), p.j).w - omega.w);
        rise.x += step * p.x;
        rise.y += step * p.y;
        rise.z += step * p.z;
      });
      const Vec3 eta = rise.total();
      const float size = length(eta);
      if (size > 0) push(f, i, epsilon / size * cross(eta, omega));
    });
  });
}

}  // namespace curlew
