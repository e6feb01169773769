// probes.csv: its columns and rows, the same bytes on any number of threads and however often a run was resumed, and no
// bit of the run changed by them.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew::test;
namespace fs = std::filesystem;

namespace {

// A dam break beside a dry half, with these keys besides.
std::string dam(const std::string& keys) {
  return R"({"curlew": 1, "particle_radius": 0.05, "domain": {"min": [0, 0, 0], "max": [2, 2, 1]},
    "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}])" +
         keys + "}";
}

const std::string probes = R"(, "probes": [
    {"name": "floor", "pressure": {"at": [0.5, 0, 0.5]}},
    {"velocity": {"from": [0, 0.2, 0.5], "to": [2, 0.2, 0.5], "points": 3}, "every": 0.05},
    {"name": "gauge", "water_height": {"at": [0, 0.5]}},
    {"name": "dry", "water_height": {"from": [1.9, 0.2], "to": [1.9, 0.8], "points": 2}}])";

}  // namespace

TEST_CASE("a run writes what its probes measure") {
  const TemporaryFolder folder;
  put_file(folder / "scene.json", dam(probes));
  const Table stats = run_in(folder.path(), "run scene.json --time 0.2", "run");
  const Table table = read_table(folder / "run/probes.csv");
  CHECK(table.columns == std::vector<std::string>{"step", "time", "floor", "probe 2[0].x", "probe 2[0].y",
                                                  "probe 2[0].z", "probe 2[1].x", "probe 2[1].y", "probe 2[1].z",
                                                  "probe 2[2].x", "probe 2[2].y", "probe 2[2].z", "gauge", "dry[0]",
                                                  "dry[1]"});
  REQUIRE(table.rows.size() == stats.rows.size());
  std::string due;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    CHECK(table.cell(row, "step") == stats.cell(row, "step"));
    CHECK(table.cell(row, "time") == stats.cell(row, "time"));
    if (row > 0) CHECK(table.number(row, "floor") > 0);
    CHECK(table.number(row, "gauge") == Approx(1).margin(0.15));
    const auto part = [&](std::size_t r) { return std::floor(table.number(r, "time") / 0.05 + 1e-9); };
    const bool wanted = row == 0 || part(row) > part(row - 1);
    CHECK(table.cell(row, "probe 2[0].x").empty() == !wanted);
    due += wanted ? "x" : "";
  }
  CHECK(due.size() == 5);
  CHECK(table.cell(0, "floor").empty());
  CHECK(table.cell(0, "dry[0]").empty());
  CHECK(table.cell(0, "probe 2[2].x").empty());
}

TEST_CASE("probes give the same bytes on any number of threads and after a resume, and change no bit") {
  const TemporaryFolder folder;
  put_file(folder / "scene.json", dam(probes));
  put_file(folder / "plain.json", dam(""));
  const std::string options = " --time 0.25 --checkpoint-every 0.08";
  const Table one = run_in(folder.path(), "run scene.json --threads 1" + options, "one");
  const Table four = run_in(folder.path(), "run scene.json --threads 4" + options, "four");
  const Table plain = run_in(folder.path(), "run plain.json" + options, "plain");
  CHECK(four.last_hash() == one.last_hash());
  CHECK(plain.last_hash() == one.last_hash());
  CHECK_FALSE(fs::exists(folder / "plain/probes.csv"));
  const std::string whole = file_text(folder / "one/probes.csv");
  CHECK(whole.size() > 1000);
  CHECK((file_text(folder / "four/probes.csv") == whole));

  for (const auto& entry : fs::directory_iterator(folder / "one/checkpoints")) {
    const std::string name = "four/checkpoints/" + entry.path().filename().string();
    INFO(name);
    run_in(folder.path(), "run --resume " + name + " --threads 2 --time 0.25", "four");
    CHECK((file_text(folder / "four/probes.csv") == whole));
  }
  // Elsewhere the table begins with the step after the checkpoint.
  run_in(folder.path(), "run --resume " + last_checkpoint(folder / "one") + " --time 0.25", "new");
  const std::string rest = file_text(folder / "new/probes.csv");
  const std::size_t header = rest.find('\n') + 1;
  CHECK(rest.size() > header);
  CHECK(rest.size() < whole.size());
  CHECK(whole.ends_with(rest.substr(header)));
}

TEST_CASE("a probe outside the domain is an error of the scene") {
  const TemporaryFolder folder;
  put_file(folder / "scene.json", dam(R"(, "probes": [{"pressure": {"at": [0.5, 2.5, 0.5]}}])"));
  const Outcome outcome = curlew_program({"run", "scene.json"}, {folder.path()});
  CHECK(outcome.code == 2);
  CHECK(outcome.err ==
        "curlew: scene.json: probes[0].pressure.at lies outside the domain at y = 2.5, expected 0 to 2\n");
}
