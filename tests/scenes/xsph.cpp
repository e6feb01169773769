// XSPH as a rate smooths velocities equally fast whatever the time step.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

constexpr double seconds = 0.4;

// A periodic shear wave that only XSPH smooths.
Run smoothed_wave(double dt, double gamma, MicropolarParameters::xsph_form_t form) {
  Scene scene = empty_box({1, 1, 0}, 20);
  scene.gravity = {};
  scene.domain.periodic = {true, true, false};
  scene.fluid.push_back(with_shear_wave(Box{{0, 0, 0}, scene.domain.max}, 0.05));
  scene.parameters.micropolar.gamma = gamma;
  scene.parameters.micropolar.xsph_form = form;
  scene.parameters.time.fixed_step = dt;
  Run run(scene);
  run.simulate(seconds);
  return run;
}

double decay_rate(const Run& run) { return std::log(0.05 / shear_wave_amplitude(run.world)) / run.world.time; }

}  // namespace

TEST_CASE("the rate form of XSPH damps alike at dt and at dt/2, and keeps momentum", "[scene]") {
  using enum MicropolarParameters::xsph_form_t;
  const double gamma = GENERATE(0.02, 0.1);
  CAPTURE(gamma);
  const Run whole = smoothed_wave(2e-3, gamma, rate), half = smoothed_wave(1e-3, gamma, rate);
  CHECK(decay_rate(whole) > 0.2);  // there is something to compare
  CHECK(decay_rate(whole) == Approx(decay_rate(half)).epsilon(0.02));
  const double drift = whole.largest([](const Moment& m) { return length(m.sums.momentum); });
  const double scale = absolute_momentum(smoothed_wave(seconds, 0, rate).world);
  CHECK(drift <= 1e-6 * scale);
}

TEST_CASE("the per-step form of XSPH damps twice as fast at half the time step", "[scene]") {
  using enum MicropolarParameters::xsph_form_t;
  const Run whole = smoothed_wave(2e-3, 0.02, step), half = smoothed_wave(1e-3, 0.02, step);
  CHECK(decay_rate(half) == Approx(2 * decay_rate(whole)).epsilon(0.02));
}
