// The lid-driven cavity: what the bench makes of a flow that is known, and a run small enough for a test.
#include <catch2/catch.hpp>
#include <cmath>

#include "app/cavity_field.h"
#include "app/cavity_reference.h"
#include "app/contour_plot.h"
#include "sim/core/passes.h"
#include "sim/scene/reader.h"
#include "tests/app/run_files.h"
#include "tests/app/svg_text.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

constexpr double pi = 3.14159265358979323846;

NodeField nodes(std::size_t across, double (*f)(double, double)) {
  NodeField field(across);
  for (std::size_t j = 0; j <= across; ++j) {
    for (std::size_t i = 0; i <= across; ++i) {
      field.at(i, j) = f(static_cast<double>(i) / double(across), static_cast<double>(j) / double(across));
    }
  }
  return field;
}

}  // namespace

TEST_CASE("the stream function of a known flow comes back from its velocities") {
  // psi = -sin^2(pi x) sin^2(pi y), at rest on all walls.
  const NodeField u = nodes(60, [](double x, double y) {
    return -2 * pi * std::pow(std::sin(pi * x), 2) * std::sin(pi * y) * std::cos(pi * y);
  });
  const NodeField v = nodes(60, [](double x, double y) {
    return 2 * pi * std::sin(pi * x) * std::cos(pi * x) * std::pow(std::sin(pi * y), 2);
  });
  const NodeField psi = stream_function(u, v);
  CHECK(psi.at(30, 30) == Approx(-1).epsilon(0.01));
  CHECK(psi.at(15, 30) == Approx(-0.5).epsilon(0.01));
  const auto vortices = cavity_vortices(psi, 1e-3);
  REQUIRE(vortices.size() == 1);
  CHECK(vortices[0].name == "PV");
  CHECK(vortices[0].x == Approx(0.5).margin(1e-6));
  CHECK(vortices[0].y == Approx(0.5).margin(1e-6));
}

TEST_CASE("corner vortices are found where they are, by the sense in which they turn") {
  const NodeField psi = nodes(100, [](double x, double y) {
    const auto hill = [&](double cx, double cy) {
      return std::exp(-200 * ((x - cx) * (x - cx) + (y - cy) * (y - cy)));
    };
    return -0.1 * hill(0.5, 0.55) + 1e-3 * hill(0.853, 0.112) - 1e-5 * hill(0.06, 0.07) + 1e-4 * hill(0.08, 0.9) +
           2e-3 * hill(0.9, 0.9);
  });
  const auto vortices = cavity_vortices(psi, 1e-6);
  REQUIRE(vortices.size() == 4);  // no vortex counts in the top right corner, below the lid's end
  CHECK(vortices[1].name == "BR1");
  CHECK(vortices[1].x == Approx(0.853).margin(1e-3));
  CHECK(vortices[1].y == Approx(0.112).margin(1e-3));
  CHECK(vortices[2].name == "TL1");
  CHECK(vortices[3].name == "BL2");
  CHECK(cavity_vortices(psi, 5e-5).size() == 3);
}

TEST_CASE("contour lines lie on their level, closed ones in one piece") {
  const NodeField cone = nodes(40, [](double x, double y) { return std::hypot(x - 0.5, y - 0.5); });
  const auto circle = contour_lines(cone, 0.3);
  REQUIRE(circle.size() == 1);
  CHECK(length(circle[0].front() - circle[0].back()) < 1e-12);
  for (const Vec3d& p : circle[0]) CHECK(std::hypot(p.x - 0.5, p.y - 0.5) == Approx(0.3).margin(1e-3));
  const auto quarters = contour_lines(cone, 0.6);  // cut off by the walls
  CHECK(quarters.size() == 4);
  CHECK(contour_lines(cone, 2).empty());
  const NodeField saddle = nodes(3, [](double x, double y) { return (x - 0.5) * (y - 0.5); });
  CHECK(contour_lines(saddle, 1e-3).size() == 2);
  CHECK(contour_lines(saddle, -1e-3).size() == 2);
  CHECK(
      well_formed(svg_text(ContourPlot{"a < b", {0.3}, {{"cone", cone, {{"PV", 0.5, 0.5}}}}, {"a note"}, "command"})));
}

TEST_CASE("a fitted velocity is exact for linear flow, and a wall's own on the wall") {
  Scene scene = parse_scene(R"({"curlew": 1, "dimension": 2, "gravity": [0, 0], "particle_radius": 0.025,
    "domain": {"min": [0, 0], "max": [1, 1], "walls": {"y+": {"kind": "no-slip", "velocity": [1, 0]}}},
    "fluid": [{"box": {"min": [0, 0], "max": [1, 1]}, "jitter": 0.3}]})",
                            "test.json");
  World world = make_world(scene);
  prepare(world, make_plan(world));
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3 p = world.fields.position[i];
    world.fields.velocity[i] = {2 * p.x - p.y, 0.5f - p.x, 0};
  }
  const Vec3d inside = fitted_velocity(world, {0.43, 0.61, 0});
  CHECK(inside.x == Approx(2 * 0.43 - 0.61).margin(1e-5));
  CHECK(inside.y == Approx(0.5 - 0.43).margin(1e-5));
  const Vec3d lid = fitted_velocity(world, {0.5, 1, 0});
  CHECK(lid.x == Approx(1).margin(1e-5));
  CHECK(lid.y == Approx(0).margin(1e-5));
}

TEST_CASE("the references are those of the papers") {
  REQUIRE(cavity_references().size() == 3);
  for (const CavityReference& r : cavity_references()) {
    CHECK(r.u.size() >= 15);
    CHECK(r.v.size() >= 15);
    for (const auto& profile : {r.u, r.v}) {
      for (std::size_t k = 1; k < profile.size(); ++k) CHECK(profile[k].at < profile[k - 1].at);
      for (const ProfilePoint& p : profile) CHECK(std::abs(p.velocity) < 0.9);
    }
    CHECK(r.vortices[0].psi < -0.1);
  }
}

TEST_CASE("a small cavity at Re 100 comes near what Ghia et al. have") {
  const TemporaryFolder folder;
  const Outcome outcome = curlew_program(
      words_of("bench accuracy cavity --nu 0.01 --cases 24 --methods dfsph --share 0.4 --out o"), {folder.path()});
  CHECK(outcome.code == 0);
  const Table table = read_table(folder / "o/accuracy_cavity_re100_24.csv");
  REQUIRE(table.rows.size() == 1);
  CHECK(table.cell(0, "method") == "DFSPH");
  CHECK(table.number(0, "rms of u") < 0.04);  // measured: 0.027
  CHECK(table.number(0, "rms of v") < 0.04);  // measured: 0.031
  const Table vortices = read_table(folder / "o/accuracy_cavity_re100_24_vortices.csv");
  CHECK(vortices.cell(0, "method") == "Ghia et al. 1982");
  REQUIRE(vortices.rows.size() > 3);
  CHECK(vortices.cell(3, "vortex") == "PV");
  CHECK(vortices.number(3, "psi") == Approx(-0.1034).epsilon(0.2));
  CHECK(vortices.number(3, "x") == Approx(0.6172).margin(0.05));
  CHECK(vortices.number(3, "y") == Approx(0.7344).margin(0.05));
  CHECK(well_formed(file_text(folder / "o/accuracy_cavity_re100_24_profiles.svg")));
  const std::string lines = file_text(folder / "o/accuracy_cavity_re100_24_streamlines.svg");
  CHECK(well_formed(lines));
  CHECK(lines.find(">PV<") != std::string::npos);
}
