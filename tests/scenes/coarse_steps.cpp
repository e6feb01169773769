// Liu et al. (2020, section 5) say that refinement still works at twice the spacing and twice the time step. So it
// does, and the micropolar model too, in every scene that comes with the program.
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/measure/diagnostics.h"
#include "sim/scene/bundled.h"
#include "sim/scene/reader.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

// Twice the spacing and twice the steps: as many spacings a step as before.
Scene coarse(Scene scene) {
  scene.particle_radius *= 2;
  TimeParameters& time = scene.parameters.time;
  time.acceleration_factor *= std::sqrt(2.0), time.max_step *= 2;
  return scene;
}

void runs_on(const Scene& scene) {
  Run run(scene);
  const double start = run.now().sums.total();
  run.simulate(2);
  CHECK(run.now().outside == 0);
  CHECK(std::isfinite(run.now().sums.total()));
  CHECK(run.largest([](const Moment& m) { return m.sums.total(); }) <= 1.05 * start);
}

}  // namespace

TEST_CASE("refinement and micropolar model run every scene at twice the spacing and twice the step", "[scene][slow]") {
  for (const SceneInfo& info : bundled_scenes(CURLEW_ASSETS_DIR)) {
    Scene refined = coarse(read_scene(info.path));
    Scene spun = refined;
    refined.parameters.vorticity_refinement.alpha = 1;
    spun.parameters.micropolar.nu_t = 0.05;
    INFO(info.name);
    {
      INFO("VR 1.0");
      runs_on(refined);
    }
    {
      INFO("MP 0.05");
      runs_on(spun);
    }
  }
}
