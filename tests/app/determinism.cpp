// The same bits whatever the number of threads, with and without pictures, and however often a run was stopped, killed
// and resumed (DESIGN 6).
#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew::test;
namespace fs = std::filesystem;

namespace {

const std::string dam_break = "run dam_break --particles 3k --steps 120";
const std::string taylor_green = "run taylor_green --steps 60";

// Waits until `ready`, as long as the program runs and for four minutes at most: others may need the cores.
template <class F>
bool wait_for(Process& process, F&& ready) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(4);
  while (std::chrono::steady_clock::now() < end) {
    if (ready()) return true;
    if (!process.running()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

std::size_t files_in(const std::string& folder, const std::string& extension) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    count += entry->path().extension() == extension;
  }
  return count;
}

std::vector<std::string> program_words(const std::string& line) {
  std::vector<std::string> words = {CURLEW_PROGRAM};
  for (const std::string& word : words_of(line)) words.push_back(word);
  return words;
}

void check_equal(const Table& table, const Table& expected) {
  CHECK(table.columns == expected.columns);
  CHECK(comparable_rows(table) == comparable_rows(expected));
  CHECK(table.last_hash() == expected.last_hash());
  CHECK(table.last_hash().size() == 16);
}

}  // namespace

TEST_CASE("any number of threads gives the same bits, pass by pass") {
  const TemporaryFolder folder;
  for (const std::string& scene : {dam_break, taylor_green}) {
    const std::string options = scene + " --columns full --hash-passes 10 --overwrite --threads ";
    const Table one = run_in(folder.path(), options + "1", "one");
    REQUIRE(one.rows.size() > 60);
    const std::string passes = file_text(folder / "one/passes.csv");
    CHECK(std::count(passes.begin(), passes.end(), '\n') > 60);
    for (const char* threads : {"2", "4", "8"}) {
      INFO(scene << " --threads " << threads);
      const Table many = run_in(folder.path(), options + threads, "many");
      check_equal(many, one);
      const bool same_passes = file_text(folder / "many/passes.csv") == passes;
      CHECK(same_passes);
    }
  }
}

TEST_CASE("a hash tells states apart, and passes.csv the first step and pass that differ") {
  const TemporaryFolder folder;
  const std::string scene = "run taylor_green --steps 3 --hash-passes 1";
  const Table a = run_in(folder.path(), scene, "a");
  const Table b = run_in(folder.path(), scene + " --set pressure.density_tolerance=1e-3", "b");
  CHECK(a.last_hash() != b.last_hash());
  const Table first = read_table(folder / "a/passes.csv"), second = read_table(folder / "b/passes.csv");
  REQUIRE(first.rows.size() == second.rows.size());
  std::size_t row = 0;
  while (row < first.rows.size() && first.rows[row] == second.rows[row]) ++row;
  REQUIRE(row < first.rows.size());
  CHECK(first.cell(row, "pass") == "density_solve");
}

TEST_CASE("pictures, other columns and files change no bit") {
  const TemporaryFolder folder;
  const Table plain = run_in(folder.path(), dam_break, "plain");
  for (const char* options :
       {" --frames --size 160x90", " --columns full", " --particles-out ply --checkpoint-every 0.1"}) {
    INFO(options);
    const Table other = run_in(folder.path(), dam_break + options + " --overwrite", "other");
    CHECK(other.last_hash() == plain.last_hash());
    CHECK(other.rows.size() == plain.rows.size());
  }
}

TEST_CASE("pictures of the turbulence models change no bit, and say where their model is off") {
  const TemporaryFolder folder;
  for (const auto& [colour, key] : {std::pair<std::string, std::string>("microrotation", "micropolar.nu_t"),
                                    {"lost_vorticity", "vorticity_refinement.alpha"}}) {
    put_file(folder / "scene.json", R"({"curlew": 1, "particle_radius": 0.05,
      "domain": {"min": [0, 0, 0], "max": [2, 2, 1]}, "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}],
      "look": {"colour_by": ")" + colour +
                                        "\"}}");
    std::string off_hash;
    for (const std::string value : {"0", "0.5"}) {
      INFO(colour << ", " << key << "=" << value);
      const std::string line = "run scene.json --steps 30 --overwrite --set " + key + "=" + value;
      const Table plain = run_in(folder.path(), line, "plain");
      const Outcome drawn = curlew_program(words_of(line + " --frames --size 160x90 --out drawn"), {folder.path()});
      REQUIRE(drawn.code == 0);
      CHECK((drawn.err.find(key + " switches it on") != std::string::npos) == (value == "0"));
      CHECK(read_table(folder / "drawn/stats.csv").last_hash() == plain.last_hash());
      CHECK(files_in(folder / "drawn/frames", ".png") > 1);
      if (value == "0") off_hash = plain.last_hash();
      if (value != "0") CHECK(plain.last_hash() != off_hash);
    }
  }
}

TEST_CASE("a checkpoint goes on to the same bits, in place and elsewhere, with other threads") {
  const TemporaryFolder folder;
  std::string with_models = dam_break;
  with_models.insert(with_models.find("--steps"),
                     "--set micropolar.nu_t=0.2 --set vorticity_confinement.epsilon=0.05 ");
  std::string refined = dam_break, summed = dam_break;
  refined.insert(refined.find("--steps"), "--set vorticity_refinement.alpha=1 --set micropolar.nu_t=0.2 ");
  summed.insert(summed.find("--steps"),
                "--set vorticity_refinement.alpha=1 --set vorticity_refinement.reconstruction=sum ");
  std::string wavelets = dam_break;
  wavelets.insert(wavelets.find("--steps"), "--set wavelet.amplitude=0.05 --set sub_particles.levels=3 ");
  for (const std::string& scene : {dam_break, taylor_green, with_models, refined, summed, wavelets}) {
    INFO(scene);
    const Table whole = run_in(folder.path(), scene + " --checkpoint-every 0.1 --threads 2 --overwrite", "whole");
    fs::remove_all(folder / "part");
    fs::copy(folder / "whole", folder / "part", fs::copy_options::recursive);
    const std::string steps = scene.substr(scene.find("--steps"));
    const std::string first = "part/checkpoints/" + [&] {
      std::string name = "~";
      for (const auto& entry : fs::directory_iterator(folder / "part/checkpoints")) {
        name = std::min(name, entry.path().filename().string());
      }
      return name;
    }();

    const Table in_place = run_in(folder.path(), "run --resume " + first + " --threads 1 " + steps, "part");
    check_equal(in_place, whole);
    CHECK(read_json(folder / "part/run.json")["resumed_from"] == first);
    CHECK(read_json(folder / "part/run.json")["changed_on_resume"] == false);

    // In another folder the table begins with the step after the checkpoint.
    const Table elsewhere = run_in(folder.path(), "run --resume " + first + " --overwrite --threads 4 " + steps, "new");
    CHECK(elsewhere.last_hash() == whole.last_hash());
    const auto all = comparable_rows(whole), rest = comparable_rows(elsewhere);
    REQUIRE(rest.size() < all.size());
    CHECK(std::vector<std::string>(all.end() - static_cast<std::ptrdiff_t>(rest.size()), all.end()) == rest);

    // Something else than the checkpoint says is recorded, and seen in the bits.
    const Table changed =
        run_in(folder.path(), "run --resume " + first + " --overwrite --set viscosity.nu=0.02 " + steps, "new");
    CHECK(changed.last_hash() != whole.last_hash());
    CHECK(read_json(folder / "new/run.json")["changed_on_resume"] == true);
  }
}

TEST_CASE("a run that was killed goes on from its last checkpoint as if nothing had been") {
  const TemporaryFolder folder;
  const Table whole = run_in(folder.path(), dam_break, "whole");
  {
    Process process(program_words(dam_break + " --checkpoint-every 0.05 --out killed --quiet"),
                    {folder.path(), {}, {}, 240});
    REQUIRE(wait_for(process, [&] { return files_in(folder / "killed/checkpoints", ".curlew") >= 3; }));
    process.send(SIGKILL);
    const Outcome outcome = process.wait();
    REQUIRE(outcome.signal == SIGKILL);
  }
  CHECK(read_json(folder / "killed/run.json")["result"]["status"] == "running");
  // What a kill in the middle of writing leaves.
  std::ofstream(folder / "killed/stats.csv", std::ios::app) << "99,0.41,0.00";
  put_file(folder / "killed/checkpoints/000099.curlew.unfinished0", "CURLEWCP");

  const std::string checkpoint = last_checkpoint(folder / "killed");
  const Table resumed = run_in(folder.path(), "run --resume " + checkpoint + " --steps 120", "killed");
  check_equal(resumed, whole);
  for (std::size_t row = 0; row < resumed.rows.size(); ++row) CHECK(resumed.cell(row, "step") == std::to_string(row));
  CHECK(unfinished_files(folder.path()).empty());
  CHECK(read_json(folder / "killed/run.json")["result"]["status"] == "done");
}

TEST_CASE("Ctrl-C ends the step in hand, saves it, and says how to go on") {
  const TemporaryFolder folder;
  const Table whole = run_in(folder.path(), dam_break, "whole");
  for (const int signal : {SIGINT, SIGTERM}) {
    INFO("signal " << signal);
    fs::remove_all(folder / "stopped");
    Process process(program_words(dam_break + " --frames --size 160x90 --out stopped"), {folder.path(), {}, {}, 240});
    REQUIRE(wait_for(process, [&] {
      const std::string text = file_text(folder / "stopped/stats.csv");
      return std::count(text.begin(), text.end(), '\n') > 20;
    }));
    process.send(signal);
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 130);
    const Table stopped = read_table(folder / "stopped/stats.csv");
    REQUIRE(stopped.rows.size() < whole.rows.size());
    const std::string checkpoint = last_checkpoint(folder / "stopped");
    CHECK(std::stoul(fs::path(checkpoint).stem().string()) == stopped.rows.size() - 1);
    const std::string name = "stopped/checkpoints/" + fs::path(checkpoint).filename().string();
    CHECK(outcome.out.ends_with("interrupted; go on with: curlew run --resume " + name + "\n"));
    CHECK(read_json(folder / "stopped/run.json")["result"]["status"] == "interrupted");
    CHECK(unfinished_files(folder.path()).empty());

    const Table resumed =
        run_in(folder.path(), "run --resume " + name + " --steps 120 --frames --size 160x90", "stopped");
    check_equal(resumed, whole);
    const double end = whole.number(whole.rows.size() - 1, "time");
    CHECK(files_in(folder / "stopped/frames", ".png") == static_cast<std::size_t>(60 * end) + 1);
  }
}

TEST_CASE("frames of a resumed run are those of the whole one") {
  const TemporaryFolder folder;
  // Pressure has no range of its own in this scene: the colour scale grows with the run, and is resumed too.
  put_file(folder / "scene.json",
           R"({"curlew": 1, "particle_radius": 0.05, "domain": {"min": [0, 0, 0], "max": [2, 2, 1]},
    "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}], "look": {"colour_by": "pressure"}})");
  const std::string options = " --frames --size 160x90 --time 0.2";
  run_in(folder.path(), "run scene.json --checkpoint-every 0.1" + options, "whole");
  const Table begun =
      run_in(folder.path(), "run scene.json --frames --size 160x90 --time 0.1 --checkpoint-every 0.1", "part");
  REQUIRE(begun.rows.size() > 10);
  run_in(folder.path(), "run --resume " + last_checkpoint(folder / "part") + options, "part");
  REQUIRE(files_in(folder / "whole/frames", ".png") == 13);
  REQUIRE(files_in(folder / "part/frames", ".png") == 13);
  for (const auto& entry : fs::directory_iterator(folder / "whole/frames")) {
    INFO(entry.path().filename());
    const bool same = file_text(entry.path()) == file_text(folder / "part/frames/" + entry.path().filename().string());
    CHECK(same);  // not the bytes themselves, in a report
  }
}
