// What the world does to a run: a disk that fills up or cannot be written to, an ffmpeg that dies, a kill at any
// moment, a machine without OpenGL. The program says so in one sentence, what it left is whole, and the run can go on.
#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "sim/io/checkpoint.h"
#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew::test;
namespace fs = std::filesystem;

namespace {

// 343 particles; a step is 5 ms of the water's time at first, and with 200 frames a second each step has its frame.
const std::string small = "run dam_break --particles 300 --steps 40 --fps 200 --quiet";
const std::string everything = " --frames --size 160x90 --particles-out ply --checkpoint-every 0.02 --hash-passes 1";

// One sentence, which is the last that the program says: a graphics driver may have complained before it.
void check_sentence(const std::string& said, const std::string& begin, const std::string& end) {
  INFO(said);
  const std::size_t line = said.rfind('\n', said.size() - 2);
  const std::string last = said.substr(line == std::string::npos ? 0 : line + 1);
  CHECK(last.starts_with("curlew: " + begin));
  CHECK(last.ends_with(end + "\n"));
}

void check_whole_picture(const std::string& file) {
  const std::string end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  CHECK(file_text(file).ends_with(end));
}

// As many bytes behind the header as it promises.
void check_whole_particles(const std::string& file) {
  const std::string text = file_text(file), mark = "end_header\n", count = "element vertex ";
  const std::size_t begin = text.find(mark), at = text.find(count);
  REQUIRE(begin != std::string::npos);
  const std::string header = text.substr(0, begin);
  std::size_t properties = 0;
  for (std::size_t k = header.find("\nproperty "); k != std::string::npos; k = header.find("\nproperty ", k + 1))
    ++properties;
  CHECK(text.size() - begin - mark.size() == 4 * properties * std::stoul(text.substr(at + count.size())));
}

// What a run left: no half file under any name, and no film, which a run that failed cannot have finished.
void check_whole_files(const std::string& run) {
  INFO(run);
  CHECK(unfinished_files(run).empty());
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const std::string file = entry.path().string(), kind = entry.path().extension().string();
    INFO(file);
    CHECK(kind != ".mp4");
    if (kind == ".csv") read_table(file);
    if (kind == ".curlew") CHECK_NOTHROW(curlew::read_checkpoint(file));
    if (kind == ".ply") check_whole_particles(file);
    if (kind == ".png") check_whole_picture(file);
    if (kind == ".json") read_json(file);
  }
}

// Files by path below a run's folder, with their bytes; tables without what differs between equal runs.
std::map<std::string, std::string> comparable_files(const std::string& run) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const std::string name = fs::relative(entry.path(), run).string();
    if (entry.is_directory() || name == "run.json") continue;
    std::string& text = files[name] = file_text(entry.path().string());
    if (name != "stats.csv") continue;
    text.clear();
    for (const std::string& row : comparable_rows(read_table(entry.path().string()))) text += row + "\n";
  }
  return files;
}

void check_same_files(const std::string& run, const std::string& whole) {
  const auto found = comparable_files(run), expected = comparable_files(whole);
  for (const auto& [name, text] : expected) {
    INFO(name);
    REQUIRE(found.contains(name));
    const bool same = found.at(name) == text;
    CHECK(same);  // not the bytes themselves, in a report
  }
  CHECK(found.size() == expected.size());
  CHECK(read_table(run + "/stats.csv").last_hash() == read_table(whole + "/stats.csv").last_hash());
}

// Runs a script of bash where `disk/` may be mounted, in name spaces of its own; what is on the disk is copied to
// kept/ before it goes.
Outcome run_with_disk(const TemporaryFolder& folder, const std::string& mount, const std::string& words) {
  put_file(folder / "disk/.keep", "");
  const std::string script = mount + " || exit 77\n" + words + "\ncode=$?\nrm -rf kept\ncp -r disk kept\nexit $code\n";
  return run_program({"unshare", "--user", "--map-root-user", "--mount", "bash", "-c", script}, {folder.path()});
}

std::string disk_of(int kilobytes) { return "mount -t tmpfs -o size=" + std::to_string(kilobytes) + "k tmpfs disk"; }

bool can_mount() {
  static const bool can = [] {
    const TemporaryFolder folder;
    return run_with_disk(folder, disk_of(64), "true").code == 0;
  }();
  if (!can) WARN("no name space with a disk of its own can be had here: not tested");
  return can;
}

// A stand-in for ffmpeg, first on PATH.
Setting with_ffmpeg(const TemporaryFolder& folder, const std::string& script) {
  put_file(folder / "bin/ffmpeg", "#!/bin/sh\n" + script + "\n");
  fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
  const char* path = std::getenv("PATH");
  return {folder.path(), {{"PATH", folder / "bin:" + (path ? path : "/usr/bin:/bin")}}};
}

std::vector<std::string> program_words(const std::string& line) {
  std::vector<std::string> words = {CURLEW_PROGRAM};
  for (const std::string& word : words_of(line)) words.push_back(word);
  return words;
}

std::size_t checkpoints_of(const std::string& run) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::directory_iterator entry(run + "/checkpoints", error), end; !error && entry != end; entry.increment(error)) {
    count += entry->path().extension() == ".curlew";
  }
  return count;
}

// Starts the program and kills it once it has written `checkpoints` more, and `delay` after that; false where it ended
// by itself before.
bool kill_after(const std::string& folder, const std::string& line, std::size_t checkpoints,
                std::chrono::microseconds delay) {
  const std::size_t before = checkpoints_of(folder + "/killed");
  Process process(program_words(line), {folder, {}, {}, 240});
  while (process.running() && checkpoints_of(folder + "/killed") < before + checkpoints)
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  if (delay.count() > 0) std::this_thread::sleep_for(delay);
  process.send(SIGKILL);
  return process.wait().signal == SIGKILL;
}

}  // namespace

TEST_CASE("a full disk is told, whatever file meets it first, and what is there is whole") {
  if (!can_mount()) return;
  struct Case {
    std::string options, file;
    int kilobytes;
  };
  // Such a disk holds pages of 4 kB: run.json takes one, and one more while it is written again at the end; stats.csv
  // takes four.
  for (const auto& [options, file, kilobytes] :
       {Case{"", "new/stats.csv", 16}, Case{"", "new/run.json", 20}, Case{" --particles-out ply", "new/particles/", 48},
        Case{" --particles-out vtk", "new/particles/", 48}, Case{" --frames --size 160x90", "new/frames/", 48},
        Case{" --checkpoint-every 0.001", "new/checkpoints/", 64}, Case{everything, "new/", 192},
        Case{everything, "new/", 320}}) {
    INFO(options << ", " << kilobytes << " kB");
    const TemporaryFolder folder;
    const Outcome outcome =
        run_with_disk(folder, disk_of(kilobytes), CURLEW_PROGRAM " " + small + " --out disk/new" + options);
    CHECK(outcome.code == 2);
    check_sentence(outcome.err, "cannot write disk/" + file, "");
    CHECK(outcome.err.find("No space left on device") != std::string::npos);
    check_whole_files(folder / "kept");
  }
}

TEST_CASE("a run that met a full disk goes on where there is room") {
  if (!can_mount()) return;
  const TemporaryFolder folder;
  const std::string line = small + everything;
  REQUIRE(curlew_program(words_of(line + " --out whole"), {folder.path()}).code == 0);
  REQUIRE(run_with_disk(folder, disk_of(320), CURLEW_PROGRAM " " + line + " --out disk/run").code == 2);
  const std::string options = line.substr(line.find("--steps"));
  const Outcome outcome =
      curlew_program(words_of("run --resume " + last_checkpoint(folder / "kept/run") + " " + options), {folder.path()});
  CHECK(outcome.err.empty());
  CHECK(outcome.code == 0);
  check_same_files(folder / "kept/run", folder / "whole");
}

TEST_CASE("a film that does not fit on the disk is no film") {
  if (!can_mount()) return;
  const TemporaryFolder folder;
  const Outcome outcome =
      run_with_disk(folder, disk_of(8), CURLEW_PROGRAM " " + small + " --size 320x180 --out new --video disk/a.mp4");
  CHECK(outcome.code == 2);
  check_sentence(outcome.err, "cannot write the video disk/a.mp4: ffmpeg gave up: ", "No space left on device");
  CHECK(folder.contents() ==
        std::vector<std::string>{"disk", "disk/.keep", "kept", "new", "new/run.json", "new/stats.csv"});
  CHECK(read_json(folder / "new/run.json")["result"]["status"] == "failed");
}

TEST_CASE("a folder that cannot be written to is told before anything runs") {
  const std::string sentence = "cannot write disk/new/run.json: ", choose = "; choose another folder";
  if (can_mount()) {
    const TemporaryFolder folder;
    const Outcome outcome = run_with_disk(folder, "mount -t tmpfs -o ro tmpfs disk",
                                          CURLEW_PROGRAM " " + small + " --out disk/new" + everything);
    CHECK(outcome.code == 2);
    check_sentence(outcome.err, sentence, "Read-only file system" + choose);
  }
  if (::geteuid() == 0) {
    WARN("root may write anywhere: folders without permission not tested");
    return;
  }
  const TemporaryFolder folder;
  fs::create_directory(folder / "disk");
  fs::permissions(folder / "disk", fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = curlew_program(words_of(small + " --out disk/new" + everything), {folder.path()});
  CHECK(outcome.code == 2);
  check_sentence(outcome.err, sentence, "Permission denied" + choose);
}

TEST_CASE("an ffmpeg that dies in the middle ends the run with its last words, and what was there stays") {
  struct Case {
    std::string script, sentence;
  };
  for (const auto& [script, sentence] :
       {Case{"head -c 500000 >/dev/null; echo warming up >&2; echo no such encoder >&2; exit 3", "no such encoder"},
        Case{"head -c 500000 >/dev/null; kill -KILL $$", "it was ended by signal 9"},
        Case{"head -c 500000 >/dev/null", "it gave no reason (exit status 0)"}}) {
    INFO(script);
    const TemporaryFolder folder;
    const Outcome outcome =
        curlew_program(words_of(small + everything + " --out new --video new/a.mp4"), with_ffmpeg(folder, script));
    CHECK(outcome.signal == 0);
    CHECK(outcome.code == 2);
    check_sentence(outcome.err, "cannot write the video new/a.mp4: ffmpeg gave up: ", sentence);
    check_whole_files(folder / "new");
    const nlohmann::json result = read_json(folder / "new/run.json")["result"];
    CHECK(result["status"] == "failed");
    CHECK(outcome.err.find(result["message"].get<std::string>()) != std::string::npos);
    CHECK(read_table(folder / "new/stats.csv").rows.size() > 5);
    CHECK(fs::exists(folder / "new/frames/000005.png"));
    CHECK(checkpoints_of(folder / "new") > 0);
  }
}

TEST_CASE("a kill at any moment leaves a run that goes on to the same end") {
  const TemporaryFolder folder;
  put_file(folder / "scene.json", R"({"curlew": 1, "dimension": 2, "particle_radius": 0.025, "gravity": [0, -9.81],
    "domain": {"min": [0, 0], "max": [2, 2]}, "fluid": [{"box": {"min": [0, 0], "max": [1, 1]}}],
    "probes": [{"name": "p", "pressure": {"at": [0.1, 0.1]}},
               {"name": "h", "water_height": {"at": [1.5]}, "every": 0.01}]})");
  const std::string options =
      " --steps 400 --fps 200 --particles-out ply --checkpoint-every 0.01 --hash-passes 3 --quiet";
  REQUIRE(curlew_program(words_of("run scene.json --out whole" + options), {folder.path()}).code == 0);

  std::mt19937 random(7);
  int kills = 0;
  for (int round = 0; round < 30; ++round) {
    INFO("round " << round);
    const bool begun = checkpoints_of(folder / "killed") > 0;
    const std::string checkpoint = begun ? last_checkpoint(folder / "killed") : "";
    const std::string line = begun ? "run --resume " + checkpoint : "run scene.json --out killed --overwrite";
    // Now and then before the first step, in every other round at once when a checkpoint shows, else anywhere.
    const std::size_t more = std::uniform_int_distribution<std::size_t>(0, 3)(random);
    const std::chrono::microseconds delay(std::uniform_int_distribution<int>(0, 12000)(random) * (round % 2));
    kills += kill_after(folder.path(), line + options, more, delay);
    if (!fs::exists(folder / "killed/stats.csv")) continue;
    read_table(folder / "killed/stats.csv");  // whole lines, at any moment
    if (checkpoints_of(folder / "killed") == 0) continue;
    CHECK_NOTHROW(curlew::read_checkpoint(last_checkpoint(folder / "killed")));
    if (begun) CHECK(last_checkpoint(folder / "killed") >= checkpoint);
  }
  CHECK(kills >= 20);
  const Outcome outcome =
      curlew_program(words_of("run --resume " + last_checkpoint(folder / "killed") + options), {folder.path()});
  CHECK(outcome.err.empty());
  REQUIRE(outcome.code == 0);
  check_whole_files(folder / "killed");
  check_same_files(folder / "killed", folder / "whole");
}

TEST_CASE("a run that goes on from an earlier checkpoint leaves none of a later step behind") {
  const TemporaryFolder folder;
  const std::string options = " --checkpoint-every 0.05 --quiet --steps ";
  const auto run = [&](const std::string& line) {
    const Outcome outcome = curlew_program(words_of("run " + line), {folder.path()});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
  };
  run("dam_break --particles 300 --out whole" + options + "60");
  fs::copy(folder / "whole", folder / "part", fs::copy_options::recursive);
  put_file(folder / "part/checkpoints/mine.curlew", "kept");
  run("--resume part/checkpoints/000010.curlew" + options + "15");  // as if it had been killed there
  CHECK(fs::remove(folder / "part/checkpoints/mine.curlew"));
  run("--resume " + last_checkpoint(folder / "part") + options + "60");
  check_same_files(folder / "part", folder / "whole");
}

TEST_CASE("pictures up to a checkpoint are there when it is") {
  const TemporaryFolder folder;
  const std::string line =
      "run dam_break --particles 300 --steps 40 --fps 200 --frames --size 640x360 --quiet "
      "--checkpoint-every 0.02 --out killed";
  REQUIRE(kill_after(folder.path(), line, 1, std::chrono::microseconds(0)));
  const curlew::Checkpoint checkpoint = curlew::read_checkpoint(last_checkpoint(folder / "killed"));
  for (int frame = 0; frame <= static_cast<int>(std::floor(checkpoint.time * 200 + 1e-9)); ++frame) {
    char name[32];
    std::snprintf(name, sizeof name, "killed/frames/%06d.png", frame);
    INFO(name);
    REQUIRE(fs::exists(folder / name));
    check_whole_picture(folder / name);
  }
}

TEST_CASE("without OpenGL only pictures fail, and leave no file") {
  const TemporaryFolder folder;
  // No vendor of EGL; a driver that is not there; an OpenGL too old.
  for (const auto& [name, value] : {std::pair<std::string, std::string>{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere"},
                                    {"LIBGL_DRIVERS_PATH", "/nowhere"},
                                    {"MESA_GL_VERSION_OVERRIDE", "3.3"}}) {
    INFO(name << "=" << value);
    const Setting without{folder.path(), {{name, value}}};
    if (curlew_program({"doctor"}, without).code != 4) {
      WARN(name << " does not take OpenGL away here: not tested");
      continue;
    }
    for (const std::string pictures : {" --frames", " --video new/a.mp4"}) {
      const Outcome outcome = curlew_program(words_of(small + " --out new" + pictures), without);
      CHECK(outcome.code == 4);
      check_sentence(outcome.err, "no off-screen OpenGL 4.5 context: tried EGL", "libegl-mesa0 libgl1-mesa-dri");
      for (const auto& entry : fs::recursive_directory_iterator(folder.path())) CHECK(entry.is_directory());
    }
    const Outcome plain = curlew_program(words_of(small + " --out new --particles-out ply"), without);
    CHECK(plain.code == 0);
    CHECK(plain.err.empty());
    CHECK(read_json(folder / "new/run.json")["result"]["status"] == "done");
    fs::remove_all(folder / "new");
  }
}
