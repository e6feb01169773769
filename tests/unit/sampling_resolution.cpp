// Numbers of particles, memory, and what radius fits.
#include <catch2/catch.hpp>

#include "sim/core/error.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"

using namespace curlew;

namespace {

Scene bundled(const std::string& name) { return read_scene(CURLEW_ASSETS_DIR "/scenes/" + name + ".json"); }

}  // namespace

TEST_CASE("dam_break takes the spacings of the published figures", "[sampling]") {
  const Scene scene = bundled("dam_break");
  const auto parts = [&](double n) { return 1 / with_particles(scene, n).spacing(); };
  CHECK(count_particles(scene) == 24389);
  CHECK(parts(24389) == 29);
  CHECK(parts(24e3) == 29);
  CHECK(parts(97336) == 46);
  CHECK(parts(97e3) == 46);
  CHECK(parts(493039) == 79);
  CHECK(parts(493e3) == 79);
  CHECK(parts(1) == 1);
  CHECK(count_particles(with_particles(scene, 493e3)) == 493039);
}

TEST_CASE("other scenes come near the number asked for", "[sampling]") {
  for (const std::string name :
       {"pillars", "hemisphere", "sphere_drop", "free_fall", "dam_break_2d", "rock", "still_tank"}) {
    for (const double n : {3e3, 2e4}) {
      const auto count = static_cast<double>(count_particles(with_particles(bundled(name), n)));
      INFO(name << " for " << n << " gives " << count);
      CHECK(count > 0.88 * n);
      CHECK(count < 1.12 * n);
    }
  }
  CHECK(count_particles(with_particles(bundled("taylor_green"), 1e4)) == 10000);
  CHECK(count_particles(with_particles(bundled("taylor_green"), 9.9e3)) ==
        9801);  // 99 x 99: periodic widths stay whole
}

TEST_CASE("numbers that make no sense are refused", "[sampling]") {
  const Scene scene = bundled("dam_break");
  for (const double n : {0.0, -5.0, 0.5, 1e10, std::nan("")}) CHECK_THROWS_AS(with_particles(scene, n), InputError);
  CHECK_THROWS_WITH(with_particles(scene, 0), "--particles is 0, expected a number from 1 to 2147483648");
}

TEST_CASE("the estimate agrees with the count", "[sampling]") {
  for (const std::string name : {"dam_break", "pillars", "sphere_drop", "free_fall", "taylor_green"}) {
    const Scene scene = bundled(name);
    CHECK(estimate_particles(scene) == Approx(static_cast<double>(count_particles(scene))).epsilon(0.06));
  }
}

TEST_CASE("what does not fit is refused before anything is allocated", "[sampling]") {
  Scene scene = bundled("dam_break");
  scene.file = "dam_break.json";
  scene.particle_radius = 1e-6;
  CHECK_THROWS_WITH(
      check_resolution(scene, 24e9),
      "dam_break.json: particle_radius 1e-6 m makes about 1.3e17 particles, which with their boundary need "
      "about 88 EB of memory where this machine has 24 GB, expected a larger particle_radius");
  CHECK_THROWS_AS(sample_fluid(scene), InputError);
  scene.particle_radius = 2e-4;
  CHECK_THROWS_WITH(
      check_resolution(scene, 1e15),
      "dam_break.json: particle_radius 0.0002 m makes about 16000000000 particles, more than the 2147483648 that "
      "can be numbered, expected a larger particle_radius");
  scene.particle_radius = 0.01;  // 125,000 particles, 88 MB
  CHECK_NOTHROW(check_resolution(scene, 88e6));
  CHECK_THROWS_AS(check_resolution(scene, 87e6), InputError);
  scene.bodies = {{"wide", Box{{0, 0, 0}, {1000, 1000, 1000}}, WallKind::slip}};  // bodies count, too
  CHECK_THROWS_AS(check_resolution(scene, 1e9), InputError);
  CHECK(machine_memory() > 1e8);
}

TEST_CASE("bytes read like people write them", "[sampling]") {
  CHECK(bytes_text(12) == "12 B");
  CHECK(bytes_text(9949) == "9.9 kB");
  CHECK(bytes_text(24.3e9) == "24 GB");
  CHECK(bytes_text(999.6e6) == "1.0 GB");
  CHECK(bytes_text(2.8e18) == "2.8 EB");
}

TEST_CASE("periodic widths must suit the kernel and the spacing", "[sampling]") {
  Scene scene = bundled("taylor_green");
  scene.file = "tg.json";
  CHECK_NOTHROW(check_resolution(scene));
  scene.particle_radius = 1.0 / 14;  // 7 particles across
  CHECK_THROWS_AS(check_resolution(scene), InputError);
  scene.particle_radius = 1.0 / 16;  // 8: just the four supports
  CHECK_NOTHROW(check_resolution(scene));
  scene.parameters.sph.h_over_d = 1.3;
  CHECK_THROWS_WITH(check_resolution(scene),
                    "tg.json: the periodic axis x is 1 m wide, expected at least 4 kernel supports, which are 1.3 m");
  scene.parameters.sph.h_over_d = 1;
  scene.particle_radius = 0.012;
  CHECK_THROWS_WITH(check_resolution(scene),
                    Catch::StartsWith("tg.json: the periodic axis x is 1 m wide, which is 41.666"));
  scene.particle_radius = 0.01 * (1 + 1e-7);
  CHECK_NOTHROW(check_resolution(scene));
}
