// Error against run time: what the bench makes of its results, and a case small enough to run.
#include "app/work_precision.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "app/setup.h"
#include "tests/app/run_files.h"
#include "tests/app/svg_text.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

PrecisionResult result(double seconds, double error) { return {"default", 10, {error}, seconds, 1, {}}; }

// The errors of Taylor-Green vortices at Re 100, in per cent, with the settings that the bench calls accurate.
std::vector<double> taylor_green_errors(int across) {
  for (const PrecisionCase& c : precision_cases()) {
    if (c.name != "taylor_green") continue;
    Scene scene = c.scene(across);
    for (const PrecisionSetting& setting : c.settings) {
      if (setting.name == "accurate") apply_settings(scene.parameters, setting.settings);
    }
    CHECK(scene.parameters.pressure.density_tolerance < 1e-4);
    std::int64_t steps = 0;
    return c.measure(scene, steps);
  }
  FAIL("there is no case taylor_green");
  return {};
}

}  // namespace

TEST_CASE("the order of convergence is the slope of the error over the resolution") {
  CHECK(observed_order(0.4, 10, 0.1, 20) == Approx(2));
  CHECK(observed_order(0.3, 10, 0.1, 30) == Approx(1));
  CHECK(observed_order(0.1, 10, 0.1, 20) == Approx(0).margin(1e-12));
  CHECK(observed_order(0.1, 10, 0.2, 20) == Approx(-1));
}

TEST_CASE("the Pareto front holds what nothing beats in both time and error") {
  PrecisionResult failed = result(0.1, 0);
  failed.errors.clear();
  const auto front = pareto_front(
      {result(4, 0.1), result(1, 0.5), result(2, 0.6), result(3, 0.2), result(3, 0.3), failed, result(5, 0.1)});
  REQUIRE(front.size() == 3);
  CHECK(front[0].seconds == 1);
  CHECK(front[1].errors[0] == 0.2);
  CHECK(front[2].seconds == 4);
}

TEST_CASE("start-up flows between plates converge in the second order, within a per cent") {
  for (const PrecisionCase& c : precision_cases()) {
    if (c.name != "couette" && c.name != "poiseuille") continue;
    INFO(c.name);
    std::int64_t steps = 0;
    const double coarse = c.measure(c.scene(10), steps)[0], fine = c.measure(c.scene(20), steps)[0];
    CHECK(fine < 1);  // per cent; measured: 0.22 and 0.81
    CHECK(observed_order(coarse, 10, fine, 20) > 1.5);
    CHECK(steps > 1000);
  }
}

TEST_CASE("Taylor-Green vortices converge in the second order") {
  const double coarse = taylor_green_errors(50)[0];
  const std::vector<double> fine = taylor_green_errors(100);
  CHECK(coarse < 1.5);  // per cent; measured: 0.88 and 0.21, and the decay rate 0.11
  CHECK(std::abs(fine[1]) < 0.5);
  CHECK(observed_order(coarse, 50, fine[0], 100) > 1.5);
}

TEST_CASE("Taylor-Green vortices converge up to 200 particles across", "[slow]") {
  const double coarse = taylor_green_errors(50)[0];
  const std::vector<double> fine = taylor_green_errors(200);
  CHECK(std::abs(fine[1]) < 0.5);
  CHECK(observed_order(coarse, 50, fine[0], 200) > 1.5);
}

TEST_CASE("a case of the bench is a table, a CSV and a plot") {
  const TemporaryFolder folder;
  const Outcome outcome = curlew_program(words_of("bench accuracy couette --cases 10 --out o"), {folder.path()});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  const Table table = read_table(folder / "o/accuracy_couette.csv");
  CHECK(table.rows.size() == 11);
  CHECK(table.number(0, "largest error (% of the plate)") < 2);
  CHECK(outcome.out.find("| default | 10 | ") != std::string::npos);
  CHECK(well_formed(file_text(folder / "o/accuracy_couette.svg")));
}
