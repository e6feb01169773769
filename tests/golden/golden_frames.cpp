// Frames of a small dam break against stored pictures, each with its tolerances as data in the .json beside it, and
// other views of it and runs with each turbulence model, whose .json says what they change in the scene (an RFC 7396
// merge patch).
//
// On the renderer, OpenGL, compiler and instruction set that made them, pictures are equal to the last bit or nearly
// so, and the tight tolerance holds. Elsewhere the loose one does: rasterisers round differently, and so do the float
// sums of another compiler or instruction set, which moves particles by a little that grows with every step. So the run
// is short (100 steps of one length; measured between gcc and clang at its end: SSIM 0.9998, at 0.4 s it would be
// 0.987).
//
// After a change that is meant to alter the pictures: CURLEW_ACCEPT_GOLDENS=1 build/release/tests/golden_tests
// writes new pictures, and the renderer that made them. Look at them before they are committed. What differed in a
// failed test lies in golden_differences/ of the folder that the test ran in.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "render/picture_difference.h"
#include "render/png.h"
#include "tests/app/run_files.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string golden_folder = CURLEW_TEST_DIR;
const std::vector<std::string> names = {"start", "collapse", "front"};
const std::vector<std::string> views = {"dark_vorticity", "top_pressure", "plain", "flat", "water", "fast_water"};
const std::vector<std::string> methods = {"refinement", "micropolar",    "confinement",
                                          "wavelets",   "sub_particles", "split_water"};

struct Frames {
  std::map<std::string, Image> pictures;
  json made_by;  // renderer, opengl, compiler, instruction_set
};

json metadata(const std::string& name) { return json::parse(file_text(golden_folder + "/" + name + ".json")); }

json golden_scene(const std::string& name = "scene") {
  return json::parse(file_text(golden_folder + "/" + name + ".json"));
}

json changed_scene(const std::string& name) {
  const json data = metadata(name);
  json scene = golden_scene(data.value("scene", "scene"));
  scene.merge_patch(data.at("changes"));
  return scene;
}

// Runs the scene and reads the frames that these goldens name.
Frames draw(const json& scene, const std::vector<std::string>& wanted = names) {
  const TemporaryFolder folder;
  put_file(folder / "scene.json", scene.dump());
  run_in(folder.path(), "run scene.json --time 0.25 --fps 20 --frames --size 320x180 --threads 2", "run");
  Frames frames;
  for (const std::string& name : wanted) {
    char number[16];
    std::snprintf(number, sizeof number, "%06d", metadata(name).at("frame").get<int>());
    frames.pictures.emplace(name, read_png(folder / "run/frames/" + number + ".png"));
  }
  const json program = read_json(folder / "run/run.json").at("program");
  for (const char* key : {"renderer", "opengl", "compiler", "instruction_set"}) frames.made_by[key] = program.at(key);
  return frames;
}

// The run of the scene as it is, once for all tests.
const Frames& frames() {
  static const Frames all = draw(golden_scene());
  return all;
}

PictureTolerance read_tolerance(const json& data) {
  return {data.at("channel"), data.at("share"), data.at("mean"), data.at("ssim")};
}

PictureTolerance tolerance(const json& data, const json& made_by) {
  return read_tolerance(data.at(data.at("made_by") == made_by ? "tolerance" : "tolerance_elsewhere"));
}

std::string text(const PictureDifference& d) {
  return std::to_string(100 * d.share) + " % of the pixels beyond the channel's tolerance, mean difference " +
         std::to_string(d.mean) + ", largest " + std::to_string(d.largest) + ", SSIM " + std::to_string(d.ssim);
}

void accept(const std::string& name, const Frames& made) {
  write_png(golden_folder + "/" + name + ".png", made.pictures.at(name));
  json data = metadata(name);
  data["made_by"] = made.made_by;
  put_file(golden_folder + "/" + name + ".json", data.dump(2) + "\n");
}

void keep_difference(const std::string& name, const Image& picture, const Image& golden) {
  fs::create_directories("golden_differences");
  write_png("golden_differences/" + name + ".new.png", picture);
  write_png("golden_differences/" + name + ".difference.png", difference_picture(picture, golden, 4));
}

// A change that a person would see must not pass, with the loose tolerance either.
void check_refused(const json& scene, const std::vector<std::string>& which = names) {
  const Frames other = draw(scene, which);
  for (const std::string& name : which) {
    const json data = metadata(name);
    const Image golden = read_png(golden_folder + "/" + name + ".png");
    for (const char* kind : {"tolerance", "tolerance_elsewhere"}) {
      const PictureTolerance allowed = read_tolerance(data.at(kind));
      const PictureDifference d = picture_difference(other.pictures.at(name), golden, allowed.channel);
      INFO(name << ", " << kind << ": " << text(d));
      CHECK_FALSE(allowed.accepts(d));
    }
  }
}

void check_same(const std::string& name, const Frames& made) {
  if (std::getenv("CURLEW_ACCEPT_GOLDENS") != nullptr) accept(name, made);
  const json data = metadata(name);
  const Image golden = read_png(golden_folder + "/" + name + ".png");
  const Image& picture = made.pictures.at(name);
  const PictureTolerance allowed = tolerance(data, made.made_by);
  const PictureDifference d = picture_difference(picture, golden, allowed.channel);
  INFO(name << ": " << text(d) << "; made by " << data.at("made_by") << ", here " << made.made_by);
  const bool same = allowed.accepts(d);
  if (!same) keep_difference(name, picture, golden);
  CHECK(same);
}

}  // namespace

TEST_CASE("three frames look as they did") {
  for (const std::string& name : names) check_same(name, frames());
}

TEST_CASE("each view looks as it did") {
  for (const std::string& name : views) check_same(name, draw(changed_scene(name), {name}));
}

TEST_CASE("each turbulence model looks as it did") {
  for (const std::string& name : methods) check_same(name, draw(changed_scene(name), {name}));
}

TEST_CASE("a turbulence model that is switched off is seen") {
  for (const std::string& name : methods) {
    json scene = changed_scene(name);
    scene["parameters"] = golden_scene()["parameters"];
    check_refused(scene, {name});
  }
}

TEST_CASE("tolerances leave room elsewhere, and none of them for much") {
  for (const std::string& name : names) {
    const json data = metadata(name);
    const PictureTolerance here = read_tolerance(data.at("tolerance")),
                           elsewhere = read_tolerance(data.at("tolerance_elsewhere"));
    CHECK(here.share <= elsewhere.share);
    CHECK(here.mean <= elsewhere.mean);
    CHECK(here.ssim >= elsewhere.ssim);
    CHECK(elsewhere.share < 0.1);
    CHECK(elsewhere.ssim > 0.9);
  }
}

TEST_CASE("a camera a little aside is seen") {
  json scene = golden_scene();
  scene["camera"]["position"] = {4.95, 2.6, 4.35};
  check_refused(scene);
}

TEST_CASE("another colour map is seen") {
  json scene = golden_scene();
  scene["look"]["colour_map"] = "viridis";
  check_refused(scene);
}

TEST_CASE("particles shifted by their radius are seen") {
  json scene = golden_scene();
  const double radius = scene["particle_radius"];
  scene["fluid"][0]["box"] = {{"min", {radius, 0, 0}}, {"max", {0.8 + radius, 1, 1.2}}};
  check_refused(scene);
}

TEST_CASE("a colour scale with another end is seen") {
  json scene = golden_scene();
  scene["look"]["range"] = {0, 4};
  check_refused(scene, {"collapse", "front"});
}

TEST_CASE("SSIM and the other measures know equal, noisy and other pictures apart") {
  Image a(64, 48), noisy(64, 48), other(64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (int k = 0; k < 4; ++k) {
        const auto at = static_cast<std::size_t>(4 * (64 * y + x) + k);
        a.rgba[at] = static_cast<std::uint8_t>(k == 3 ? 255 : (x / 8 + y / 8) % 2 ? 200 : 50);
        noisy.rgba[at] = static_cast<std::uint8_t>(a.rgba[at] - (k < 3 && (7 * x + 3 * y) % 5 == 0 ? 2 : 0));
        other.rgba[at] = static_cast<std::uint8_t>(k == 3 ? 255 : ((x + 4) / 8 + y / 8) % 2 ? 200 : 50);
      }
    }
  }
  const PictureDifference none = picture_difference(a, a, 0), little = picture_difference(a, noisy, 0),
                          much = picture_difference(a, other, 0);
  CHECK(none.share == 0);
  CHECK(none.ssim == Approx(1));
  CHECK(little.share == Approx(0.2).margin(0.01));
  CHECK(little.mean == Approx(0.4).margin(0.02));
  CHECK(little.ssim > 0.99);
  CHECK(picture_difference(a, noisy, 2).share == 0);
  CHECK(much.share == Approx(0.5).margin(0.05));
  CHECK(much.ssim < 0.5);
  CHECK_FALSE(picture_difference(a, Image(64, 47), 0).same_size);
}
