// `curlew bench render`: what a picture costs in each look, without a window.
#include <omp.h>

#include <chrono>
#include <cstdio>

#include "app/bench.h"
#include "app/progress.h"
#include "render/context.h"
#include "render/renderer.h"
#include "sim/core/frame.h"
#include "sim/surface/surface.h"

namespace curlew {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int width = 1280, height = 720;
constexpr double splash_time = 0.6;  // s: the wave is between the pillars
constexpr double scene_nu = 0.002;   // m^2/s

struct LookCase {
  const char* name;
  LookStyle style;
};
constexpr LookCase looks[] = {
    {"particles", LookStyle::particles}, {"water", LookStyle::water}, {"fast-water", LookStyle::fast_water}};

// Medians in ms.
struct PictureCost {
  double drawn = 0, read = 0;
};

PictureCost measure(Renderer& renderer, const Frame& frame, const ViewSettings& view) {
  std::vector<double> drawn, read;
  const auto begin = Clock::now();
  // The first picture is made again: drivers compile shaders with it.
  for (int k = -1; k < 3 || (k < 30 && Clock::now() - begin < std::chrono::seconds(4)); ++k) {
    const auto start = Clock::now();
    renderer.render(frame, view);
    (void)renderer.point_at(0, 0);  // waits for the card
    const auto middle = Clock::now();
    (void)renderer.read();
    if (k < 0) continue;
    drawn.push_back(1e3 * std::chrono::duration<double>(middle - start).count());
    read.push_back(1e3 * std::chrono::duration<double>(Clock::now() - middle).count());
  }
  return {median(drawn), median(read)};
}

}  // namespace

int bench_render(const BenchOptions& options) {
  const OffscreenContext context;
  std::printf("pillars at %g s, %d x %d, %s, %d threads\n\n", splash_time * options.time_share, width, height,
              context.info().renderer.c_str(), omp_get_max_threads());
  std::printf(
      "| look | particles | triangles | ms a picture | and to read it back | surface, ms "
      "|\n|---|---|---|---|---|---|\n");
  const std::vector<std::string> cases =
      options.cases.empty() ? std::vector<std::string>{"30k", "100k"} : options.cases;
  for (const std::string& particles : cases) {
    const Scene scene = bench_scene("pillars", scene_nu, particles, options);
    World world = make_world(scene);
    const Plan plan = make_plan(world, surface_demand() | colour_demand(scene.look.colour_by));
    prepare(world, plan);
    Progress progress(false);
    while (world.time < splash_time * options.time_share) {
      step(world, plan);
      progress.show(world.time / (splash_time * options.time_share), "pillars " + particles);
    }
    progress.finish();
    Renderer renderer(width, height);
    SurfaceMaker maker;
    for (const LookCase& look : looks) {
      ViewSettings view;
      view.camera = scene.camera;
      view.look = scene.look;
      view.look.style = look.style;
      const bool coloured = look.style == LookStyle::particles;
      Frame frame = make_frame(world, coloured ? scene.look.colour_by : "none", make_geometry(scene));
      double surface = 0;
      std::size_t triangles = 0;
      if (look.style == LookStyle::water) {
        for (int k = 0; k < 2; ++k) frame.surface = make_surface(world, maker, view.look.cut);  // once for its memory
        triangles = frame.surface->triangles.size();
        surface = maker.times().level_set + maker.times().polygonise + maker.times().smooth;
      }
      const PictureCost cost = measure(renderer, frame, view);
      std::printf("| %s | %zu | %zu | %.1f | %.1f | %.1f |\n", look.name, world.count, triangles, cost.drawn, cost.read,
                  surface);
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace curlew
