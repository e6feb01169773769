// What a run and the listing commands leave and print is what DESIGN 7 and 8 promise.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>

#include "sim/io/checkpoint.h"
#include "sim/measure/state_hash.h"
#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string small = "run dam_break --particles 1k --steps 40";

const std::vector<std::string> basic_columns = {"step",
                                                "time",
                                                "dt",
                                                "particles",
                                                "kinetic",
                                                "rotational",
                                                "potential",
                                                "mechanical",
                                                "total",
                                                "max_speed",
                                                "density_error_avg",
                                                "density_error_true_avg",
                                                "density_error_true_max",
                                                "divergence_error",
                                                "pressure_iterations",
                                                "divergence_iterations",
                                                "limit_hits",
                                                "outside",
                                                "ms_step"};

// Every cell is a number; only the hash may be empty.
void check_cells(const Table& table) {
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (const std::string& column : table.columns) {
      if (column != "state_hash") CHECK(std::isfinite(table.number(row, column)));
    }
  }
}

void check_milliseconds(const Table& table) {
  double passes = 0, steps = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    double sum = 0;
    for (const std::string& column : table.columns) {
      if (!column.starts_with("ms_") || column == "ms_step") continue;
      CHECK(table.number(row, column) >= 0);
      sum += table.number(row, column);
    }
    CHECK(sum <= table.number(row, "ms_step"));
    passes += sum;
    steps += table.number(row, "ms_step");
  }
  CHECK(passes > 0.3 * steps);  // over the run, which a busy machine disturbs less than a step
}

std::vector<std::string> bundled_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(CURLEW_ASSETS_DIR "/scenes")) names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("run.json says what ran") {
  const TemporaryFolder folder;
  run_in(folder.path(), small + " --seed 5 --threads 2 --set viscosity.nu=0.01 --frames --size 160x90", "a");
  const json run = read_json(folder / "a/run.json");
  CHECK(run["command"] ==
        "curlew " + small + " --seed 5 --threads 2 --set viscosity.nu=0.01 --frames --size 160x90 --out a --quiet");
  CHECK(run["seed"] == 5);
  CHECK(run["program"]["version"].get<std::string>().starts_with("curlew "));
  CHECK_FALSE(run["program"]["instruction_set"].get<std::string>().empty());
  CHECK_FALSE(run["program"]["compiler"].get<std::string>().empty());
  CHECK(run["program"]["threads"] == 2);
  CHECK_FALSE(run["program"]["renderer"].get<std::string>().empty());
  CHECK(run["program"]["opengl"].get<std::string>().find("4.") != std::string::npos);
  CHECK(run["result"]["status"] == "done");
  CHECK(run["result"]["steps"] == 40);
  CHECK(run["result"]["particles"] == 1000);
  CHECK(run["result"]["solver_bytes"] > 100000);
  // Every parameter stands in the scene, also those that nobody set.
  const json list = json::parse(curlew_program({"params", "--json"}).out);
  CHECK(run["scene"]["parameters"].size() == list.size());
  for (const json& row : list) {
    INFO(row["key"]);
    const json& value = run["scene"]["parameters"].at(row["key"].get<std::string>());
    CHECK(value == (row["key"] == "viscosity.nu" ? json(0.01) : row["default"]));
  }
}

TEST_CASE("the scene in run.json runs again to the same bits") {
  const TemporaryFolder folder;
  // The rock brings a mesh from a file, the sphere drop two fluids, Taylor-Green periodic axes in 2D.
  for (const char* line : {"run rock --particles 2k --steps 10 --set viscosity.nu=0.01",
                           "run sphere_drop --radius 0.04 --steps 10", "run taylor_green --steps 10"}) {
    INFO(line);
    const Table first = run_in(folder.path(), std::string(line) + " --overwrite", "first");
    put_file(folder / "elsewhere/again.json", read_json(folder / "first/run.json")["scene"].dump());
    const Table again = run_in(folder.path(), "run elsewhere/again.json --steps 10 --overwrite", "again");
    CHECK(comparable_rows(again) == comparable_rows(first));
    CHECK(again.last_hash() == first.last_hash());
    CHECK(read_json(folder / "again/run.json")["scene"] == read_json(folder / "first/run.json")["scene"]);
  }
}

TEST_CASE("stats.csv has the columns of the manual, a row a step, and disjoint milliseconds") {
  const TemporaryFolder folder;
  const Table basic = run_in(folder.path(), small, "basic");
  REQUIRE(basic.columns.size() > basic_columns.size());
  CHECK(std::vector<std::string>(basic.columns.begin(), basic.columns.begin() + 19) == basic_columns);
  CHECK(basic.columns.back() == "state_hash");
  for (std::size_t k = basic_columns.size(); k + 1 < basic.columns.size(); ++k) {
    INFO(basic.columns[k]);
    CHECK(basic.columns[k].starts_with("ms_"));
  }
  CHECK(std::set<std::string>(basic.columns.begin(), basic.columns.end()).size() == basic.columns.size());
  REQUIRE(basic.rows.size() == 41);
  for (std::size_t row = 0; row < basic.rows.size(); ++row) {
    CHECK(basic.cell(row, "step") == std::to_string(row));
    CHECK(basic.cell(row, "state_hash").size() == (row == 40 ? 16 : 0));
  }
  check_cells(basic);
  check_milliseconds(basic);

  const Table full = run_in(folder.path(), small + " --columns=full", "full");
  for (const char* column : {"px", "py", "pz", "lx", "ly", "lz", "enstrophy", "helicity", "loss_density_solve",
                             "loss_divergence_solve", "work_gravity", "divergence_error_after_models", "state_hash"}) {
    full.place(column);
  }
  for (std::size_t row = 0; row < full.rows.size(); ++row) CHECK(full.cell(row, "state_hash").size() == 16);
  check_cells(full);
  check_milliseconds(full);
  for (std::size_t row = 1; row < full.rows.size(); ++row) {
    for (const char* column : {"time", "dt", "mechanical", "density_error_avg"}) {
      CHECK(full.cell(row, column) == basic.cell(row, column));
    }
  }
}

TEST_CASE("what the passes took from the kinetic energy is what it lost") {
  const TemporaryFolder folder;
  // At 0.4 s the water of the dam break hits a wall; the vortices lose by viscosity.
  for (const char* line : {"run dam_break --particles 500 --steps 120", "run taylor_green --steps 20",
                           "run dam_break --particles 500 --steps 60 --set micropolar.nu_t=0.2 "
                           "--set vorticity_refinement.alpha=1 --set vorticity_confinement.epsilon=0.1 "
                           "--set viscosity.nu=0.01 --set micropolar.gamma=0.01"}) {
    INFO(line);
    const Table table = run_in(folder.path(), std::string(line) + " --columns full --overwrite", "a");
    for (std::size_t row = 1; row < table.rows.size(); ++row) {
      double loss = 0, spin = 0;
      for (const std::string& column : table.columns) {
        if (column.starts_with("loss_")) loss += table.number(row, column);
        if (column.starts_with("work_") && column != "work_spin") loss -= table.number(row, column);
        if (column == "work_spin") spin = table.number(row, column);
      }
      const double before = table.number(row - 1, "kinetic"), after = table.number(row, "kinetic");
      CHECK(loss == Approx(before - after).margin(2e-7 * (1 + before)));
      CHECK(spin == Approx(table.number(row, "rotational") - table.number(row - 1, "rotational")).margin(1e-9));
    }
    CHECK(table.number(1, "work_gravity") >= 0);
  }
}

TEST_CASE("stats a frame are the rows of the frames and the last") {
  const TemporaryFolder folder;
  const Table all = run_in(folder.path(), "run dam_break --particles 1k --time 0.11 --fps 25", "all");
  const Table frames =
      run_in(folder.path(), "run dam_break --particles 1k --time 0.11 --fps 25 --stats=frame", "frames");
  REQUIRE(frames.rows.size() == 4);  // at 0, 0.04 and 0.08 s, and the end
  CHECK(frames.cell(0, "time") == "0");
  for (std::size_t row = 1; row < 3; ++row) {
    const double due = 0.04 * static_cast<double>(row), time = frames.number(row, "time");
    CHECK(time >= due);
    CHECK(time - frames.number(row, "dt") < due);  // the first state at or past the frame's time
  }
  const auto rows = comparable_rows(all), some = comparable_rows(frames);
  for (const std::string& row : some) CHECK(std::count(rows.begin(), rows.end(), row) == 1);
  CHECK(frames.last_hash() == all.last_hash());
}

TEST_CASE("each frame has its particle file, in three formats, and nothing half written stays") {
  const TemporaryFolder folder;
  for (const std::string format : {"vtk", "ply", "bgeo"}) {
    INFO(format);
    run_in(folder.path(), "run dam_break --particles 1k --time 0.1 --fps 40 --particles-out " + format, format);
    for (int frame = 0; frame <= 4; ++frame) {
      const std::string file = folder / format + "/particles/00000" + std::to_string(frame) + "." + format;
      CHECK(fs::file_size(file) > 1000 * 28);  // id, position, velocity at least
    }
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / format + "/particles")) ++files;
    CHECK(files == 5);
  }
  CHECK(unfinished_files(folder.path()).empty());
}

TEST_CASE("a checkpoint and a frame of the same time are of the same step") {
  const TemporaryFolder folder;
  // Ten steps of 0.005 s end a little before 0.05 s.
  run_in(folder.path(),
         "run dam_break --particles 1k --time 0.1 --set time.fixed_step=0.005 --fps 20 --checkpoint-every 0.05 "
         "--particles-out ply",
         "run");
  for (const char* file : {"checkpoints/000010.curlew", "checkpoints/000020.curlew", "particles/000002.ply"})
    CHECK(std::filesystem::exists(folder / ("run/" + std::string(file))));
  CHECK_FALSE(std::filesystem::exists(folder / "run/checkpoints/000011.curlew"));
}

TEST_CASE("a quiet run says nothing, and else plain lines go to where they belong") {
  const TemporaryFolder folder;
  const Setting here{folder.path()};
  const Outcome quiet = curlew_program(words_of(small + " --out a --quiet"), here);
  CHECK(quiet.code == 0);
  CHECK(quiet.out.empty());
  CHECK(quiet.err.empty());
  const Outcome loud = curlew_program(words_of(small + " --out b"), here);
  CHECK(loud.out.starts_with("b: 1000 particles, 40 steps, "));
  CHECK(loud.out.ends_with("state " + read_table(folder / "b/stats.csv").last_hash() + "\n"));
  CHECK(loud.err.find('\r') == std::string::npos);
  CHECK(loud.err.find("\x1b") == std::string::npos);
  CHECK(loud.err.find("100 %") != std::string::npos);
}

TEST_CASE("without --out a run stands in out/ under the name of its scene's file") {
  const TemporaryFolder folder;
  const Setting here{folder.path()};
  put_file(folder / "my scene.json", R"({"curlew": 1, "name": "../../not here", "particle_radius": 0.1,
    "domain": {"min": [0, 0, 0], "max": [1, 1, 1]}, "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 0.5, 1]}}]})");
  CHECK(curlew_program({"run", "my scene.json", "--steps", "1"}, here).code == 0);
  CHECK(curlew_program(words_of("run taylor_green --steps 1"), here).code == 0);
  CHECK(fs::exists(folder / "out/my scene/run.json"));
  CHECK(fs::exists(folder / "out/taylor_green/run.json"));
}

TEST_CASE("overwriting replaces what a run left, and nothing else") {
  const TemporaryFolder folder;
  run_in(folder.path(), small + " --particles-out ply --checkpoint-every 0.05", "a");
  put_file(folder / "a/notes.txt", "mine");
  run_in(folder.path(), "run dam_break --particles 500 --steps 3 --overwrite", "a");
  CHECK(folder.contents() == std::vector<std::string>{"a", "a/notes.txt", "a/run.json", "a/stats.csv"});
  CHECK(read_json(folder / "a/run.json")["result"]["steps"] == 3);
}

TEST_CASE("params lists every parameter for programs, people and editors") {
  const json list = json::parse(curlew_program({"params", "--json"}).out);
  REQUIRE(list.size() > 20);
  const std::string text = curlew_program({"params"}).out, markdown = curlew_program({"params", "--markdown"}).out;
  const json schema = json::parse(curlew_program({"params", "--schema"}).out);
  for (const json& row : list) {
    const std::string key = row["key"];
    INFO(key);
    for (const char* name :
         {"key", "type", "default", "min", "max", "slider_min", "slider_max", "unit", "symbol", "doc", "live"}) {
      CHECK(row.contains(name));
    }
    if (row["type"] == "number" || row["type"] == "integer") {
      CHECK(row["min"] <= row["slider_min"]);
      CHECK(row["slider_min"] < row["slider_max"]);
      CHECK(row["slider_max"] <= row["max"]);
      CHECK(row["min"] <= row["default"]);
      CHECK(row["default"] <= row["max"]);
    }
    CHECK(text.find("  " + key + " = ") != std::string::npos);
    CHECK(markdown.find("| `" + key + "` |") != std::string::npos);
    CHECK(schema["properties"]["parameters"]["properties"].contains(key));
  }
}

TEST_CASE("assets/scene.schema.json is what `params --schema` prints") {
  const bool same = curlew_program({"params", "--schema"}).out == file_text(CURLEW_ASSETS_DIR "/scene.schema.json");
  INFO("curlew params --schema > assets/scene.schema.json");
  CHECK(same);
}

TEST_CASE("the README's table of parameters is what `params --markdown` prints") {
  const std::string readme = file_text(CURLEW_ASSETS_DIR "/../README.md");
  const bool same = readme.find("\n" + curlew_program({"params", "--markdown"}).out) != std::string::npos;
  INFO("README.md, \"Parameters\": put in what curlew params --markdown prints");
  CHECK(same);
}

TEST_CASE("version, help and scenes answer on standard output") {
  const Outcome version = curlew_program({"--version"});
  CHECK(version.code == 0);
  CHECK(version.out.starts_with("curlew "));
  CHECK(std::count(version.out.begin(), version.out.end(), '\n') == 1);
  for (const char* line : {"--help", "run --help", "check --help", "bench --help", "params --help"}) {
    const Outcome help = curlew_program(words_of(line));
    INFO(line);
    CHECK(help.code == 0);
    CHECK(help.err.empty());
    CHECK(help.out.size() > 100);
  }
  const Outcome scenes = curlew_program({"scenes"});
  CHECK(scenes.code == 0);
  for (const std::string& name : bundled_names())
    CHECK(("\n" + scenes.out).find("\n" + name + " ") != std::string::npos);
}

TEST_CASE("doctor says what this machine can do") {
  const Outcome with = curlew_program({"doctor"});
  CHECK(with.code == 0);
  CHECK(with.out.find("off-screen frames: yes, ") != std::string::npos);
  const Outcome without = curlew_program({"doctor"}, {{}, {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null"}}});
  CHECK(without.code == 4);
  CHECK(without.out.find("off-screen frames: no: ") != std::string::npos);
}

TEST_CASE("check reads every bundled scene and says what it holds") {
  for (const std::string& name : bundled_names()) {
    const Outcome check = curlew_program({"check", name});
    INFO(name << ": " << check.err);
    CHECK(check.code == 0);
    CHECK(check.err.empty());
    CHECK(check.out.find(" fluid particles, ") != std::string::npos);
    CHECK(check.out.find(" bytes a particle") != std::string::npos);
  }
}

TEST_CASE("a run that diverges names pass and particle and saves the state before") {
  const TemporaryFolder folder;
  const std::string base = "run dam_break --particles 1k --steps 200 --out a --overwrite ";
  struct Case {
    std::string options, pass;
  };
  // Viscosity beyond its explicit limit blows up; a step that is far too long throws the particles across the box.
  for (const auto& [options, pass] :
       {Case{"--set viscosity.nu=10 --set time.viscosity_factor=10 --set time.fixed_step=0.01", "energy_watch"},
        Case{"--set time.fixed_step=0.05", "density_solve"}}) {
    INFO(options);
    const Outcome outcome = curlew_program(words_of(base + options + " --particles-out ply"), {folder.path()});
    CHECK(outcome.code == 3);
    const Table table = read_table(folder / "a/stats.csv");
    const std::string step = std::to_string(table.rows.size());
    const std::string begin = "curlew: the simulation diverged at step " + step + ", time " +
                              table.cell(table.rows.size() - 1, "time") + " s: after pass " + pass + " particle ";
    const std::string said = outcome.err.substr(outcome.err.find("curlew: "));
    CHECK(said.starts_with(begin));
    CHECK(said.ends_with(
        "; use a smaller time.fixed_step; the state before that step is in a/checkpoints/diverged.curlew\n"));
    CHECK(std::count(said.begin(), said.end(), '\n') == 1);
    const json run = read_json(folder / "a/run.json");
    CHECK(run["result"]["status"] == "diverged");
    CHECK(run["result"]["message"].get<std::string>().starts_with(begin.substr(8)));

    const curlew::Checkpoint saved = curlew::read_checkpoint(folder / "a/checkpoints/diverged.curlew");  // all finite
    CHECK(saved.step == static_cast<std::int64_t>(table.rows.size()) - 1);
    CHECK(saved.fields.id.size() == 1000);
    CHECK(table.cell(table.rows.size() - 1, "step") == std::to_string(saved.step));
    CHECK(table.cell(table.rows.size() - 1, "state_hash") == curlew::hash_text(curlew::state_hash(saved.fields)));
    CHECK(table.cell(table.rows.size() - 2, "state_hash").empty());
    CHECK(unfinished_files(folder.path()).empty());
  }
}

TEST_CASE("a state before divergence goes on with gentler settings") {
  const TemporaryFolder folder;
  const Outcome outcome = curlew_program(
      words_of("run dam_break --particles 1k --steps 50 --out a --quiet --set time.fixed_step=0.3"), {folder.path()});
  REQUIRE(outcome.code == 3);
  const Table table =
      run_in(folder.path(), "run --resume a/checkpoints/diverged.curlew --set time.fixed_step=0.001 --steps 30", "b");
  CHECK(table.cell(table.rows.size() - 1, "step") == "30");
}

TEST_CASE("a video holds every frame, as ffprobe counts them") {
  const TemporaryFolder folder;
  if (std::system("ffprobe -version >/dev/null 2>&1") != 0) {
    WARN("no ffprobe here: not tested");
    return;
  }
  run_in(folder.path(), "run dam_break --particles 500 --time 0.5 --fps 24 --size 160x90 --video a/film.mp4", "a");
  const Outcome probe =
      run_program({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                   "stream=nb_read_frames,width,height,r_frame_rate", "-of", "csv=p=0", folder / "a/film.mp4"});
  CHECK(probe.code == 0);
  CHECK(probe.out == "160,90,24/1,13\n");
  CHECK(read_json(folder / "a/run.json")["result"]["frames"] == 13);
  CHECK_FALSE(fs::exists(folder / "a/frames"));
  CHECK(unfinished_files(folder.path()).empty());
}
