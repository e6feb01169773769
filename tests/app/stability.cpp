// `curlew bench stability` at sizes that take seconds, what it calls a run, and its pictures.
#include "app/stability.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <set>
#include <thread>

#include "app/heat_map.h"
#include "tests/app/run_files.h"
#include "tests/app/svg_text.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;
namespace fs = std::filesystem;

namespace {

const std::string small = "bench stability --scenes dam_break_2d --cases 200 --time 0.1 --out s --threads 2 ";

Outcome in(const TemporaryFolder& folder, const std::string& line) {
  return curlew_program(words_of(line), {folder.path()});
}

// The table without wall times, which no two runs share.
std::vector<std::string> without_wall(const Table& table) {
  std::vector<std::string> rows;
  for (const std::vector<std::string>& cells : table.rows) {
    std::string row;
    for (std::size_t k = 0; k + 1 < cells.size(); ++k) row += cells[k] + ",";
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

TEST_CASE("a run is called what its end says") {
  StabilityRun run;
  run.kinetic = 4;
  CHECK(classify(run, 2) == Verdict::calm);  // lively is more than twice
  CHECK(classify(run, 1.99) == Verdict::lively);
  run.kinetic = NAN;
  run.too_slow = true;
  CHECK(classify(run, 1) == Verdict::too_slow);
  run.pass = "density_solve";
  CHECK(classify(run, 1) == Verdict::diverged);
  for (const Verdict verdict : {Verdict::calm, Verdict::lively, Verdict::diverged, Verdict::too_slow}) {
    CHECK(parse_verdict(verdict_name(verdict)) == verdict);
  }
  CHECK_FALSE(parse_verdict("fine"));
}

TEST_CASE("points that are the same run are run once") {
  CHECK(canonical({.eta = 0.5, .guard = true}) == StabilityPoint{});
  CHECK(canonical({.step = 2, .guard = true}) == StabilityPoint{.step = 2});
  const StabilityPoint spins{.nu_t = 0.1, .eta = 0.5, .guard = true};
  CHECK(canonical(spins) == spins);
  const StabilityPoint pushes{.epsilon = 0.1, .guard = true};
  CHECK(canonical(pushes) == pushes);
}

TEST_CASE("a point reaches the parameters that it is about") {
  const Scene scene;
  const Parameters before = scene.parameters;
  const Parameters p =
      at_point(scene, {.alpha = 1, .nu_t = 0.2, .eta = 0.3, .epsilon = 0.4, .step = 3, .viscosity = 2}).parameters;
  CHECK(p.vorticity_refinement.alpha == 1);
  CHECK(p.micropolar.nu_t == 0.2);
  CHECK(p.micropolar.eta == 0.3);
  CHECK(p.vorticity_confinement.epsilon == 0.4);
  CHECK_FALSE(p.energy.guard);
  CHECK(p.time.cfl == Approx(3 * before.time.cfl));
  CHECK(p.time.acceleration_factor == Approx(3 * before.time.acceleration_factor));
  CHECK(p.time.max_step == Approx(3 * before.time.max_step));
  // Twice the viscosity at which its limit is the default's largest step.
  const double d = scene.spacing();
  CHECK(before.time.viscosity_factor * d * d / p.viscosity.nu == Approx(before.time.max_step / 2));
  CHECK(at_point(scene, {.viscosity_factor = 4}).parameters.time.viscosity_factor ==
        Approx(4 * before.time.viscosity_factor));
}

TEST_CASE("lines and planes have names of their own and ascending values") {
  std::set<std::string> names;
  for (const StabilityMap& map : stability_maps()) {
    INFO(map.name);
    CHECK(names.insert(map.name).second);
    CHECK(std::is_sorted(map.xs.begin(), map.xs.end()));
    CHECK(std::is_sorted(map.ys.begin(), map.ys.end()));
    CHECK(map.is_line() == (map.ys.size() == 1));
  }
  CHECK(names.size() == 13);
}

TEST_CASE("a heat map is well-formed, escapes its texts and marks what it should") {
  HeatMap map{"Up & down", 2, {}, {{"#d3e7f4", "#000000"}, {"#6d1a36", "#ffffff"}}, {"A < b."}, "curlew \"x\" <y>"};
  map.panels.push_back({"Left & right",
                        {"speed <m/s>", {"1", "2", "3"}, 1},
                        {"size", {"a", "b"}, 0},
                        {{0, "calm", "1"}, {0, "calm", "2"}, {1, "bad & worse", "3", true}, {0, "calm", "4"}, {}, {}}});
  map.panels.push_back({"Empty", {"x", {}, -1}, {"", {}, -1}, {}});
  const std::string svg = svg_text(map);
  CHECK(well_formed(svg));
  for (const char* words : {">Up &amp; down<", ">Left &amp; right<", ">speed &lt;m/s&gt;<", ">bad &amp; worse<",
                            ">A &lt; b.<", ">curlew &quot;x&quot; &lt;y&gt;<", ">Empty<"}) {
    INFO(words);
    CHECK(svg.find(words) != std::string::npos);
  }
  CHECK(count(svg, ">calm<") == 3);
  CHECK(count(svg, "fill=\"#d3e7f4\"") == 3);  // empty cells have no colour
  CHECK(count(svg, "fill=\"#6d1a36\"") == 1);
  CHECK(count(svg, "h-12l12 12z") == 1);
  CHECK(count(svg, "class=\"limit\"") == 2);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("the stability bench leaves its cells, a summary and maps, and runs only what is missing") {
  const TemporaryFolder folder;
  const Outcome outcome = in(folder, small + "alpha resolution");
  REQUIRE(outcome.code == 0);
  CHECK(folder.contents() ==
        std::vector<std::string>{"s", "s/cells.csv", "s/lines.svg", "s/settings.txt", "s/summary.md"});
  const std::string csv = folder / "s/cells.csv";
  const Table table = read_table(csv);
  REQUIRE(table.rows.size() == 3 + 2 * 7 + 2 * 3);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    INFO(row);
    CHECK(table.cell(row, "scene") == "dam_break_2d");
    CHECK(table.cell(row, "verdict") == "calm");
    CHECK(table.number(row, "end") >= 0.1);
    CHECK(table.number(row, "steps") > 10);
    CHECK(table.number(row, "kinetic_ratio") == Approx(1).margin(0.2));
  }
  CHECK(table.cell(0, "map") == "plain");
  CHECK(table.number(0, "resolution") == 0.5);
  CHECK(table.number(0, "kinetic_ratio") == 1);
  CHECK(table.number(2, "particles") > 1.5 * table.number(1, "particles"));
  CHECK(table.cell(3 + 6, "alpha") == "3");
  CHECK(table.cell(3 + 6, "kinetic") != table.cell(3, "kinetic"));
  const std::string summary = file_text(folder / "s/summary.md");
  CHECK(outcome.out.starts_with(summary));
  CHECK(summary.find("| refinement, α (1) | 0 to 3 | 2D | - | - | - | - | ") != std::string::npos);
  CHECK(well_formed(file_text(folder / "s/lines.svg")));

  const std::string before = file_text(csv);
  const Outcome again = in(folder, small + "alpha resolution");
  CHECK(again.code == 0);
  CHECK(again.err.empty());
  CHECK(file_text(csv) == before);  // with its wall times

  // One line less in the table: that run alone is made again, to the same numbers. Rows of other lines stay.
  const std::string last = before.substr(before.rfind('\n', before.size() - 2) + 1);
  put_file(csv, before.substr(0, before.size() - last.size()));
  const Outcome repaired = in(folder, small + "resolution");
  CHECK(repaired.code == 0);
  CHECK(repaired.err.find("0 of 1 runs") != std::string::npos);
  auto rows = without_wall(read_table(csv)), expected = without_wall(table);
  std::sort(rows.begin(), rows.end());
  std::sort(expected.begin(), expected.end());
  CHECK(rows == expected);

  put_file(csv, before + "dam_break_2d,1\n");
  const Outcome damaged = in(folder, small + "alpha");
  CHECK(damaged.code == 2);
  CHECK(damaged.err ==
        "curlew: s/cells.csv: line 25 has 2 cells, expected 25; remove the line, or the file, to run it again\n");
  CHECK(in(folder, small + "alpha --set sph.h_over_d=1.1").code == 2);
}

TEST_CASE("a cell that diverges says when and where") {
  const TemporaryFolder folder;
  const Outcome outcome = in(folder, small + "step --set time.max_displacement=0.2");
  REQUIRE(outcome.code == 0);
  const Table table = read_table(folder / "s/cells.csv");
  CHECK(table.cell(0, "verdict") == "calm");
  const std::size_t last = table.rows.size() - 1;
  CHECK(table.cell(last, "step") == "4");
  CHECK(table.cell(last, "verdict") == "diverged");
  CHECK(table.cell(last, "pass") != "-");
  CHECK(table.number(last, "end") < 0.1);
  CHECK(table.cell(last, "kinetic_ratio").empty());
  CHECK(outcome.out.find(" s, " + table.cell(last, "pass") + ")") != std::string::npos);
}

TEST_CASE("where plain DFSPH diverges the stability bench has nothing to compare with") {
  const TemporaryFolder folder;
  const Outcome outcome = in(folder, small + "step --set time.max_displacement=0.12");
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("curlew: plain DFSPH diverged in dam_break_2d at ") != std::string::npos);
  CHECK(outcome.err.find("nothing to be compared with; leave out what --set changes\n") != std::string::npos);
}

TEST_CASE("the stability bench refuses what it cannot do in one sentence") {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"bench stability speed",
       "the line or plane is \"speed\", expected one of alpha, nu_t, eta, epsilon, amplitude, step, viscosity, "
       "viscosity_factor, resolution, alpha_x_nu_t, alpha_x_amplitude, nu_t_x_eta, alpha_x_step"},
      {"bench stability --scenes hemisphere", "--scenes is \"hemisphere\", expected dam_break_2d or dam_break"},
      {"bench stability --set time.cfl=0.2", "--set gives time.cfl, which this benchmark varies itself; leave it out"},
      {"bench stability --nu 0.05", "curlew bench stability takes no --nu; see `curlew bench --help`"},
      {"bench stability --cases 1k 2k", "--cases has 2 numbers, and this benchmark takes one"}};
  for (const auto& [line, sentence] : cases) {
    INFO(line);
    const Outcome outcome = in(folder, line);
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "curlew: " + std::string(sentence) + "\n");
  }
  CHECK(folder.contents().empty());
}

TEST_CASE("Ctrl-C ends the stability bench, which then goes on") {
  const TemporaryFolder folder;
  Process process(words_of(CURLEW_PROGRAM " bench stability alpha --scenes dam_break_2d --cases 200 --time 2 --out s"),
                  {folder.path()});
  while (!fs::exists(folder / "s/cells.csv") && process.running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  CHECK(outcome.code == 130);
  CHECK(outcome.out == "interrupted; the same command goes on with the runs that were in hand\n");
  CHECK(folder.contents() == std::vector<std::string>{"s", "s/cells.csv", "s/settings.txt"});
}
