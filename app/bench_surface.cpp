// `curlew bench surface`: what the water's surface costs, from particles with their density to a mesh with normals.
#include <omp.h>

#include <chrono>
#include <cstdio>

#include "app/bench.h"
#include "app/progress.h"
#include "sim/surface/surface.h"

namespace curlew {
namespace {

using Clock = std::chrono::steady_clock;

struct SurfaceCase {
  const char* name;
  const char* particles;
  double time;     // s of the dam break before it is measured
  double cell;     // particle radii
  int levels = 0;  // of vortex sub-particles
};

// A block at rest, and the moment at which the dam break is torn apart most, after it hit the far wall.
constexpr SurfaceCase cases[] = {{"block", "100k", 0, 1},     {"splash", "100k", 0.9, 1},
                                 {"splash", "20k", 0.9, 1.5}, {"splash", "20k", 0.9, 1},
                                 {"splash", "40k", 0.9, 1},   {"splash, split", "40k", 0.9, 1, 3}};

World state_at(const SurfaceCase& c, const BenchOptions& options) {
  Scene scene = bench_scene("dam_break", 0, c.particles, options);
  scene.parameters.surface.cell = c.cell;
  scene.parameters.sub_particles.levels = c.levels;
  World world = make_world(scene);
  const Plan plan = make_plan(world, {FieldId::density});
  prepare(world, plan);
  Progress progress(false);
  while (world.time < c.time * options.time_share) {
    step(world, plan);
    progress.show(world.time / c.time, std::string(c.name) + " " + c.particles);
  }
  return world;
}

}  // namespace

int bench_surface(const BenchOptions& options) {
  constexpr int repeats = 31;
  std::printf("dam_break, %d threads, medians of %d, %s\n\n", omp_get_max_threads(), repeats, CURLEW_ISA_NAME);
  std::printf(
      "| water | particles | cell | triangles | ms | of which level set | marching cubes | smoothing | triangles a "
      "second "
      "| bytes a particle |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const SurfaceCase& c : cases) {
    const World world = state_at(c, options);
    SurfaceMaker maker;
    std::vector<double> all, level_set, polygonise, smooth;
    for (int k = 0; k < repeats; ++k) {
      const auto begin = Clock::now();
      const Fields& f = world.fields;
      maker.make({f.position, f.density, {}, f.sub_particles, f.id, world.time}, world.scene);
      all.push_back(1e3 * std::chrono::duration<double>(Clock::now() - begin).count());
      level_set.push_back(maker.times().level_set);
      polygonise.push_back(maker.times().polygonise);
      smooth.push_back(maker.times().smooth);
    }
    const double ms = median(all), triangles = static_cast<double>(maker.mesh().triangles.size());
    std::printf("| %s | %zu | %g r | %.0f | %.1f | %.1f | %.1f | %.1f | %.1f M | %.0f |\n", c.name, world.count, c.cell,
                triangles, ms, median(level_set), median(polygonise), median(smooth), 1e-3 * triangles / ms,
                static_cast<double>(maker.bytes()) / static_cast<double>(world.count));
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace curlew
