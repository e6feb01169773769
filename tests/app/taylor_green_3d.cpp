// The Taylor-Green vortex in 3D: what the bench makes of a curve of energy, and a run small enough for a test.
#include "app/taylor_green_3d.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "app/work_precision.h"
#include "tests/app/run_files.h"
#include "tests/app/svg_text.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

TEST_CASE("the loss is the slope of the energy, and known only where the curve reaches around it") {
  EnergyCurve curve;
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.1 * k;
    curve.time.push_back(t);
    curve.energy.push_back(1 - 0.01 * t + 2.7e-5 * std::pow(t - 5, 3));
  }
  CHECK(std::isnan(curve.loss(0.1, 0.5)));
  CHECK(std::isnan(curve.loss(9.9, 0.5)));
  CHECK(curve.loss(5, 0.5) == Approx(0.01).epsilon(0.01));
  CHECK(curve.largest_loss(0.5).time == Approx(5).margin(0.1));
  CHECK(curve.at(0.05) == Approx((curve.energy[0] + curve.energy[1]) / 2));
  CHECK(std::isnan(curve.at(10.1)));
}

TEST_CASE("the vortex begins with the velocities of its formula, in a box of 2 pi") {
  const PrecisionRun run(taylor_green_3d_scene(16));
  CHECK(run.world.count == 16 * 16 * 16);
  CHECK(run.world.scene.domain.max.z == Approx(2 * 3.14159265358979));
  double worst = 0;
  for (std::size_t i = 0; i < run.world.count; ++i) {
    const Vec3d p = to_double(run.world.fields.position[i]);
    const Vec3d exact{std::sin(p.x) * std::cos(p.y) * std::cos(p.z), -std::cos(p.x) * std::sin(p.y) * std::cos(p.z), 0};
    worst = std::max(worst, length(to_double(run.world.fields.velocity[i]) - exact));
  }
  CHECK(worst < 1e-5);
  EnergyCurve curve;
  curve.add(run.world);
  CHECK(curve.energy[0] == Approx(0.125).epsilon(0.01));
}

TEST_CASE("a small Taylor-Green vortex in 3D keeps its energy, with refinement too") {
  const TemporaryFolder folder;
  const Outcome outcome = curlew_program(
      words_of("bench accuracy taylor_green_3d --cases 16 --methods dfsph vr1.0 --share 0.1 --out o"), {folder.path()});
  CHECK(outcome.code == 0);
  const Table table = read_table(folder / "o/accuracy_taylor_green_3d_16.csv");
  REQUIRE(table.rows.size() == 3);
  CHECK(table.cell(0, "method") == "DNS");
  CHECK(table.number(0, "energy at t = 1") == Approx(0.12452));
  // Particles off their lattice have 0.1253 J/kg at the start, and 9 steps later 0.1252, with refinement 0.1245.
  CHECK(table.number(1, "energy at t = 1") > 0.1245);
  CHECK(table.number(2, "energy at t = 1") > 0.1225);
  const Table curves = read_table(folder / "o/accuracy_taylor_green_3d_16_curves.csv");
  REQUIRE(curves.rows.size() > 61 + 10);
  for (std::size_t k = 61; k < curves.rows.size(); ++k) CHECK(curves.number(k, "energy") < 1.003 * 0.12532);
  CHECK(well_formed(file_text(folder / "o/accuracy_taylor_green_3d_16.svg")));
}
