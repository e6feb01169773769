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

constexpr const char* base =
    "run dam_break --particles 2k --time 0.1 --fps 20 --frames --size 240x136 --hash-passes 1 --quiet "
    "--set viscosity.nu=0.01";

void run(const TemporaryFolder& folder, const std::string& name, const std::string& more = "",
         const std::string& look = "water") {
  const std::string line = std::string(base) + " --look " + look + " --out " + name + " " + more;
  const Outcome outcome = curlew_program(words_of(line), {.folder = folder.path()});
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
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
  run(folder, "golden");

  SECTION("the same again") {
    run(folder, "new", "--threads 1");
    const Outcome outcome = compare(folder, "golden new");
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "identical: the same state and the same pictures\nreport: new/compare.html\n");
    const std::string page = file_text(folder / "new/compare.html");
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
  run(folder, "golden");
  SECTION("another renderer") {
    run(folder, "new");
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

TEST_CASE("compare names what is missing or damaged, with exit code 2") {
  const TemporaryFolder folder;
  run(folder, "golden");
  run(folder, "new");
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
