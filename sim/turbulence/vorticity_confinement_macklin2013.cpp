#include "sim/turbulence/vorticity_confinement_macklin2013.h"

#include <cmath>

#include "sim/core/parallel.h"

namespace curlew {

void vorticity_confinement(World& world) {
  ++world.work.sweeps;
  world.work.pair_visits += world.neighbours.pairs();
  Fields& f = world.fields;
  const auto epsilon = static_cast<float>(world.parameters().vorticity_confinement.epsilon);
  // |omega| once a particle, in w of what it is the length of.
  parallel_for(world.count, [&](std::size_t i) { f.vorticity[i].w = length(f.vorticity[i]); });
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 omega = f.vorticity[i];
      f8 x{}, y{}, z{};
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        const f8 rise = world.kernel.slope(p.r2) * (gather(f.vorticity.data(), p.j).w - omega.w);
        x += rise * p.x;
        y += rise * p.y;
        z += rise * p.z;
      });
      const Vec3 eta{sum(x), sum(y), sum(z)};
      const float size = length(eta);
      if (size > 0) f.acceleration[i] += epsilon / size * cross(eta, omega);
    });
  });
}

}  // namespace curlew
