// `curlew compare`: the verdict names what changed, and each kind of change is caught by the layer that it belongs to.
//
// A program whose solver or renderer changed is stood in for by a run with another parameter, whose run.json then says
// the golden's: to the comparison both look the same.
#include <filesystem>
#include <functional>

#include "app/compare.h"
#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

// Eight steps whose length is a power of two: they end at the times of frames and checkpoints to the last bit. Frames 0
// to 2; the checkpoint of step 8 is of the state that 000002.png shows.
constexpr const char* base =
    "run dam_break --particles 2k --time 0.0625 --fps 32 --frames --size 160x90 --hash-passes 1 --quiet "
    "--checkpoint-every 0.0625 --set time.fixed_step=0.0078125 --set viscosity.nu=0.01";

void run_line(const TemporaryFolder& folder, const std::string& name, const std::string& line) {
  const Outcome outcome = curlew_program(words_of(line + " --out " + name), {.folder = folder.path()});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
}

void run(const TemporaryFolder& folder, const std::string& name, const std::string& more = "",
         const std::string& look = "water") {
  run_line(folder, name, std::string(base) + " --look " + look + " " + more);
}

// The same run each time, so it is made once.
void put_golden(const TemporaryFolder& folder, const std::string& name = "golden") {
  static const TemporaryFolder once;
  if (once.contents().empty()) run(once, "golden");
  fs::copy(once / "golden", folder / name, fs::copy_options::recursive);
}

Outcome compare(const TemporaryFolder& folder, const std::string& words) {
  return curlew_program(words_of("compare " + words), {.folder = folder.path()});
}

// Lets `name` say that it ran what the golden did.
void pretend(const TemporaryFolder& folder, const std::string& name) {
  json data = read_json(folder / (name + "/run.json"));
  data["scene"] = read_json(folder / "golden/run.json").at("scene");
  put_file(folder / (name + "/run.json"), data.dump());
}

void edit(const TemporaryFolder& folder, const std::string& name, const std::function<void(json&)>& change) {
  json data = read_json(folder / (name + "/run.json"));
  change(data);
  put_file(folder / (name + "/run.json"), data.dump());
}

std::string verdict(const Outcome& outcome) { return outcome.out.substr(0, outcome.out.find('\n')); }

}  // namespace

TEST_CASE("compare says identical, or what changed and where") {
  const TemporaryFolder folder;
  put_golden(folder);
  fs::remove_all(folder / "golden/checkpoints");  // stored states have their own test below

  SECTION("the same again") {
    run(folder, "new", "--threads 1");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "identical: the same state and the same pictures\nreport: new/compare.html\n");
    CHECK(compare(folder, "golden new --report page.html --quiet").code == 0);
    const std::string page = file_text(folder / "new/compare.html");
    CHECK(file_text(folder / "page.html") == page);
    CHECK(page.find("data:image/png;base64,iVBOR") != std::string::npos);
    CHECK(page.find("curlew compare golden new --accept") != std::string::npos);
    CHECK(page.find("http") == std::string::npos);
  }
  SECTION("a parameter by a per cent") {
    run(folder, "new", "--set viscosity.nu=0.0101");
    const Outcome outcome = compare(folder, "golden new --quiet");
    CHECK(outcome.code == 1);
    CHECK(outcome.out == "a parameter differs: parameters.viscosity.nu is 0.01 in GOLDEN and 0.0101 in NEW\n");
  }
  SECTION("a parameter of the picture only") {
    run(folder, "new", "--set surface.cell=2");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 1);
    CHECK(verdict(outcome) == "a parameter differs: parameters.surface.cell is 1 in GOLDEN and 2 in NEW");
  }
  SECTION("the solver") {
    run(folder, "new", "--set viscosity.nu=0.010001");
    pretend(folder, "new");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 1);
    // In the first step everything is at rest, and viscosity changes nothing.
    CHECK(verdict(outcome) == "the simulation first differed at step 2 in the pass viscosity");
    fs::remove(folder / "golden/passes.csv");
    CHECK(verdict(compare(folder, "golden new"))
              .starts_with("the simulation first differed at step 2 or shortly before"));
  }
  SECTION("the surface") {
    run(folder, "new", "--set surface.iso=0.7");
    pretend(folder, "new");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 1);
    CHECK(verdict(outcome).starts_with("the rendering changed: 00000"));
    CHECK(verdict(outcome).ends_with("of the same state"));
  }
  SECTION("the shaders") {
    run(folder, "new", "", "fast-water");
    pretend(folder, "new");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 1);
    CHECK(verdict(outcome).starts_with("the rendering changed: 00000"));
  }
  SECTION("accepted") {
    run(folder, "new", "--set viscosity.nu=0.02");
    put_file(folder / "golden/compare.json", "{}");
    CHECK(compare(folder, "golden new --accept").code == 0);
    CHECK(compare(folder, "golden new").code == 0);
    CHECK(fs::exists(folder / "golden/compare.json"));
  }
}

TEST_CASE("compare takes another renderer for what it is, and holds what another compiler made to tolerances") {
  const TemporaryFolder folder;
  put_golden(folder);
  fs::remove_all(folder / "golden/checkpoints");
  SECTION("another renderer") {
    put_golden(folder, "new");
    edit(folder, "new", [](json& data) { data["program"]["renderer"] = "another"; });
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("NEW by another: only the loose tolerance counts for pictures\n") != std::string::npos);
  }
  SECTION("another compiler, the same within tolerances") {
    run(folder, "new", "--set viscosity.nu=0.0100001");
    pretend(folder, "new");
    edit(folder, "new", [](json& data) { data["program"]["compiler"] = "another"; });
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 0);
    CHECK(verdict(outcome) == "the same within the tolerances");
    CHECK(outcome.err.find("different compilers") != std::string::npos);
    // With tolerances of its own the golden is stricter.
    put_file(folder / "golden/compare.json", R"({"state": {"kinetic": {"share": 1e-12, "absolute": 0}}})");
    CHECK(compare(folder, "golden new").code == 1);
  }
  SECTION("another compiler, something else") {
    run(folder, "new", "--set viscosity.nu=0.2");
    pretend(folder, "new");
    edit(folder, "new", [](json& data) { data["program"]["compiler"] = "another"; });
    CHECK(compare(folder, "golden new").code == 1);
  }
}

TEST_CASE("compare draws the golden run's stored state again and holds it to the picture of the same step") {
  const TemporaryFolder folder;
  put_golden(folder);
  const auto page = [&] { return file_text(folder / "new/compare.html"); };
  const auto holds = [](const std::string& text, const std::string& part) { return text.find(part) != text.npos; };
  const std::string drawn_row = "<td>000002.png of 000008.curlew</td><td>0 %</td><td>0</td><td>0</td>";
  // Stands in for a renderer that changed since the golden run: then its picture of this state is another.
  const auto redraw_golden = [&] {
    run(folder, "other", "", "fast-water");
    for (const char* name : {"golden", "new"})
      fs::copy_file(folder / "other/frames/000002.png", folder / (std::string(name) + "/frames/000002.png"),
                    fs::copy_options::overwrite_existing);
  };

  SECTION("nothing changed") {
    put_golden(folder, "new");
    edit(folder, "golden", [](json& data) {
      std::string command = data["command"];
      data["command"] = command.replace(command.find("--fps 32"), 8, "--fps=32");
    });
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(holds(page(), drawn_row));
  }
  SECTION("the rendering, which shows in no picture of the new run") {
    put_golden(folder, "new");
    redraw_golden();
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 1);
    CHECK(verdict(outcome).starts_with("the rendering changed: 000002.png differs most, in "));
    CHECK(verdict(outcome).ends_with("), of the golden's stored state"));
    CHECK(holds(page(), "<tr class=\"off\"><td>000002.png of 000008.curlew</td>"));
  }
  SECTION("the simulation alone, and both") {
    run(folder, "new", "--set viscosity.nu=0.02");
    const std::string parameter = "a parameter differs: parameters.viscosity.nu is 0.01 in GOLDEN and 0.02 in NEW",
                      solver = "the simulation first differed at step 2 in the pass viscosity";
    const std::string other_parameter = file_text(folder / "new/run.json");
    pretend(folder, "new");
    CHECK(verdict(compare(folder, "golden new")) == solver);
    CHECK(holds(page(), drawn_row));
    redraw_golden();
    const std::string with_solver = verdict(compare(folder, "golden new"));
    CHECK(with_solver.starts_with("the rendering changed: 000002.png differs most, in "));
    CHECK(with_solver.ends_with("), of the golden's stored state; and " + solver));
    put_file(folder / "new/run.json", other_parameter);
    CHECK(verdict(compare(folder, "golden new")).ends_with("), of the golden's stored state; and " + parameter));
  }
  SECTION("the simulation, within the tolerances of its numbers but not of its pictures") {
    run(folder, "new", "--set viscosity.nu=0.2");
    pretend(folder, "new");
    edit(folder, "new", [](json& data) { data["program"]["compiler"] = "another"; });
    put_file(folder / "golden/compare.json",
             R"({"state": {}, "loose": {"channel": 0, "share": 0, "mean": 0, "ssim": 1}})");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 1);
    CHECK(verdict(outcome).starts_with("the simulation changed, within the tolerances of its state but not of its "));
    CHECK(verdict(outcome).ends_with("and the golden's stored state is drawn as before"));
    fs::remove_all(folder / "golden/checkpoints");
    CHECK(verdict(compare(folder, "golden new")).starts_with("the rendering changed: "));
  }
  SECTION("where this machine draws otherwise or not at all, the layer is left out") {
    put_golden(folder, "new");
    redraw_golden();
    const Outcome without = curlew_program(words_of("compare golden new"),
                                           {folder.path(), {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null"}}});
    CHECK(without.code == 0);
    CHECK(without.err.starts_with("curlew: warning: GOLDEN's stored states are not drawn again: no off-screen OpenGL"));
    for (const char* name : {"golden", "new"})
      edit(folder, name, [](json& data) { data["program"]["renderer"] = "another"; });
    const Outcome elsewhere = compare(folder, "golden new");
    CHECK(elsewhere.code == 0);
    CHECK(
        elsewhere.err.starts_with("curlew: warning: GOLDEN's stored states are not drawn again: it was drawn by "
                                  "another, OpenGL 4.5"));
  }
  SECTION("without a stored state nothing is said but in the page") {
    put_golden(folder, "new");
    for (const char* lacking : {"the number of frames", "the checkpoint"}) {
      if (std::string(lacking) == "the checkpoint") fs::remove_all(folder / "golden/checkpoints");
      // Not what the command gives, as in a run that was resumed: who knows which frame is of which state.
      edit(folder, "golden", [](json& data) { data["result"]["frames"] = 2; });
      const Outcome outcome = compare(folder, "golden new");
      CAPTURE(lacking);
      CHECK(outcome.code == 0);
      CHECK(outcome.err.empty());
      CHECK(holds(page(), "GOLDEN has no checkpoint of a moment that one of its pictures shows"));
    }
  }
  SECTION("accepted with its checkpoints") {
    run(folder, "new", "--set viscosity.nu=0.02");
    const std::string checkpoint = file_text(folder / "new/checkpoints/000008.curlew");
    CHECK(compare(folder, "golden new --accept").err.empty());
    CHECK(file_text(folder / "golden/checkpoints/000008.curlew") == checkpoint);
    fs::remove_all(folder / "new/checkpoints");
    CHECK(compare(folder, "golden new --accept").err ==
          "curlew: warning: GOLDEN's checkpoints are gone, for NEW has none; run it with --checkpoint-every to store "
          "states again\n");
    CHECK_FALSE(fs::exists(folder / "golden/checkpoints"));
  }
  SECTION("damaged") {
    put_golden(folder, "new");
    std::string bytes = file_text(folder / "golden/checkpoints/000008.curlew");
    bytes[bytes.size() / 2] ^= 1;
    put_file(folder / "golden/checkpoints/000008.curlew", bytes);
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 2);
    CHECK(outcome.err.starts_with("curlew: golden/checkpoints/000008.curlew is damaged"));
  }
}

TEST_CASE("compare draws stored states again in every look, where a picture is of the same step") {
  const TemporaryFolder folder;
  put_file(folder / "scene.json", R"({
    "curlew": 1, "name": "Drop", "particle_radius": 0.05, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
    "fluid": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 1]}}],
    "look": {"style": "particles", "colour_by": "vorticity", "cut": {"axis": "z", "at": 0.6, "keep": "low"}},
    "parameters": {"time.fixed_step": 0.0078125}
  })");
  // Falls, so that its colours span less than the scale, which knows the frames before.
  put_file(folder / "flat.json", R"({
    "curlew": 1, "name": "Fall", "dimension": 2, "particle_radius": 0.02, "domain": {"min": [0, 0], "max": [1, 1]},
    "fluid": [{"box": {"min": [0.2, 0.4], "max": [0.6, 0.9]}, "velocity": [0, -2]}],
    "look": {"colour_by": "height"}, "parameters": {"time.fixed_step": 0.0078125}
  })");
  const std::string end = " --time 0.0625 --fps 16 --checkpoint-every 0.03125 --frames --size 160x90 --quiet";
  const auto [line, name] = GENERATE(table<std::string, std::string>({
      {"run scene.json", "particles, cut open, in colours of a field that no checkpoint has"},
      {"run flat.json", "flat, in colours whose scale the run chose"},
      {"run dam_break --particles 500 --look fast-water --set time.fixed_step=0.0078125", "fast water"},
  }));
  CAPTURE(name);
  run_line(folder, "golden", line + end);
  const Outcome outcome = compare(folder, "golden golden");
  CHECK(outcome.code == 0);
  const std::string page = file_text(folder / "golden/compare.html");
  CHECK(page.find("<td>000001.png of 000008.curlew</td><td>0 %</td><td>0</td><td>0</td>") != std::string::npos);
  CHECK(page.find("of 000004.curlew") == std::string::npos);  // no picture shows that state
}

TEST_CASE("compare names what is missing or damaged, with exit code 2") {
  const TemporaryFolder folder;
  put_golden(folder);
  put_golden(folder, "new");
  const auto refused = [&](const std::string& end) {
    const Outcome outcome = compare(folder, "golden new");
    CAPTURE(outcome.err, end);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find(end) != std::string::npos);
  };
  CHECK(compare(folder, "nowhere new").err == "curlew: nowhere: there is no such folder, expected one of a run\n");
  SECTION("a picture") {
    put_file(folder / "golden/frames/000001.png", file_text(folder / "golden/frames/000001.png").substr(0, 300));
    refused("golden/frames/000001.png: is no PNG picture that can be read");
  }
  SECTION("run.json") {
    fs::remove(folder / "golden/run.json");
    refused("golden/run.json: there is no such file");
  }
  SECTION("a run that broke off") {
    edit(folder, "golden", [](json& data) { data["result"]["status"] = "interrupted"; });
    refused("golden/run.json: the run is \"interrupted\", expected one that is done");
  }
  SECTION("a ragged table") {
    put_file(folder / "golden/stats.csv", "step,time,state_hash\n0,0\n");
    refused("golden/stats.csv: line 2 has 2 cells, expected 3 as in the first line");
  }
  SECTION("tolerances with a typo") {
    put_file(folder / "golden/compare.json", R"({"tigth": {}})");
    refused("golden/compare.json");
  }
  SECTION("no picture in the new run") {
    fs::remove(folder / "new/frames/000001.png");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 1);
    CHECK(verdict(outcome).starts_with("the rendering changed: 000001.png differs most"));
  }
}
