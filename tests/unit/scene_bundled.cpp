// The scenes that come with the program, and the schema.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "sim/core/error.h"
#include "sim/scene/bundled.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"
#include "sim/scene/schema.h"

using namespace curlew;

namespace {

const std::filesystem::path assets = CURLEW_ASSETS_DIR;

}  // namespace

TEST_CASE("every bundled scene reads, says what it is, and holds particles", "[scene]") {
  const auto scenes = bundled_scenes(assets);
  CHECK(scenes.size() >= 9);
  for (const SceneInfo& info : scenes) {
    INFO(info.name);
    CHECK(info.about.size() > 30);
    const Scene scene = read_scene(info.path);
    CHECK(scene.about == info.about);
    CHECK_NOTHROW(check_resolution(scene));
    const std::string text = scene_json(scene);
    CHECK(scene_json(parse_scene(text, "elsewhere.json")) == text);
  }
  const auto count = [](const std::string& name) { return count_particles(read_scene(find_scene(name, assets))); };
  CHECK(count("dam_break") == 29 * 29 * 29);
  CHECK(count("still_tank") == 29 * 29 * 29);
  CHECK(count("hemisphere") == 24 * 36 * 36);
  CHECK(count("taylor_green") == 50 * 50);
  CHECK(count("dam_break_2d") == 60 * 60);
  CHECK(count("pillars") > 35000);
  CHECK(count("pillars") < 45000);
  CHECK(count("ball") > 22000);
  CHECK(count("ball") < 24000);
}

TEST_CASE("scenes are found by name and by path", "[scene]") {
  CHECK(find_scene("pillars", assets) == assets / "scenes/pillars.json");
  CHECK(find_scene((assets / "scenes/rock.json").string(), assets) == assets / "scenes/rock.json");
  CHECK_THROWS_WITH(find_scene("pilars", assets),
                    "there is no scene \"pilars\"; did you mean the bundled scene \"pillars\"?");
  CHECK_THROWS_WITH(find_scene("nowhere/dam_brek.json", assets),
                    "there is no scene \"nowhere/dam_brek.json\"; did you mean the bundled scene \"dam_break\"?");
  CHECK_THROWS_WITH(find_scene("ocean", assets),
                    "there is no scene \"ocean\", expected a file or a name that `curlew scenes` lists");
  CHECK_THROWS_AS(bundled_scenes("/nowhere"), InputError);
}

TEST_CASE("assets/scene.schema.json is what the program prints", "[scene]") {
  std::ostringstream text;
  text << std::ifstream(assets / "scene.schema.json").rdbuf();
  const bool same = text.str() == scene_schema();
  INFO("if not: curlew params --schema > assets/scene.schema.json");
  CHECK(same);
}
