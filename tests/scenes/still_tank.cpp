// Water at rest stays at rest under hydrostatic pressure, p = rho g (H - y).
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

constexpr double filled_height = 1;  // m

// The scene with a viscosity that lets a tank come to rest.
Scene still_tank(int particles_per_metre) {
  Scene scene = at_particles_per_metre(bundled("still_tank"), particles_per_metre);
  scene.parameters.viscosity.nu = 0.01;
  return scene;
}

// Pressure at the floor, Pa: the mean over the kernel's support above it, carried down from its mean height.
double floor_pressure(const World& world) {
  double pressure = 0, height = 0, number = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const double y = double{world.fields.position[i].y};
    if (y > world.kernel.support()) continue;
    pressure += double{world.fields.pressure[i]};
    height += y;
    ++number;
  }
  return (pressure + world.parameters().sph.rest_density * -world.scene.gravity.y * height) / number;
}

struct Rest {
  double rms_speed = 0;          // m/s, largest in the last second
  double floor_pressure = 0;     // Pa, mean over the last second
  double floor_fluctuation = 0;  // Pa, rms about that mean
};

Rest last_second_of(Run& run, double seconds) {
  run.simulate(seconds - 1);
  Rest rest;
  double sum = 0, squares = 0, number = 0;
  for (const double end = run.world.time + 1; run.world.time < end; ++number) {
    run.take_steps(1);
    rest.rms_speed = std::max(rest.rms_speed, rms_speed(run.world));
    const double pressure = floor_pressure(run.world);
    sum += pressure;
    squares += pressure * pressure;
  }
  rest.floor_pressure = sum / number;
  rest.floor_fluctuation = std::sqrt(std::max(0.0, squares / number - rest.floor_pressure * rest.floor_pressure));
  return rest;
}

void check_rest(Run& run, double seconds, double speed_bound, double pressure_bound) {
  const Scene& scene = run.world.scene;
  const double g = -scene.gravity.y, hydrostatic = scene.parameters.sph.rest_density * g * filled_height;
  const Rest rest = last_second_of(run, seconds);
  WARN(run.world.count << " particles: rms speed " << rest.rms_speed / std::sqrt(g * filled_height)
                       << " sqrt(gH), floor pressure " << rest.floor_pressure / hydrostatic
                       << " rho g H, its rms fluctuation " << rest.floor_fluctuation / hydrostatic);
  CHECK(rest.rms_speed <= speed_bound * std::sqrt(g * filled_height));
  CHECK(rest.floor_pressure == Approx(hydrostatic).epsilon(pressure_bound));
  CHECK_NOFAIL(rest.rms_speed <= 0.01 * std::sqrt(g * filled_height));  // the aim at every resolution
  CHECK(run.largest([](const Moment& m) { return m.outside; }) == 0);
  CHECK(run.energy_rise(0.5) <= 1e-3);
}

}  // namespace

// A coarse tank is held to less: its first layer of particles is a larger share of the depth.
TEST_CASE("a still tank rests under hydrostatic pressure", "[scene]") {
  Run run(still_tank(18), {FieldId::pressure});
  CHECK(run.world.count == 18 * 18 * 18);
  check_rest(run, 4, 0.015, 0.015);
}

TEST_CASE("a still tank with 24k particles rests for 10 s", "[scene][slow]") {
  Run run(still_tank(29), {FieldId::pressure});
  CHECK(run.world.count == 29 * 29 * 29);
  check_rest(run, 10, 0.01, 0.01);
}
