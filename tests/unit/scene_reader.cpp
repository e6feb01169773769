// Scenes as read: values, defaults, comments, and the round trip through scene_json.
#include <catch2/catch.hpp>
#include <filesystem>
#include <tuple>

#include "sim/core/error.h"
#include "sim/scene/reader.h"
#include "sim/scene/sampling.h"

using namespace curlew;

namespace {

const std::string full_scene = R"json({
  // a comment
  "curlew": 1, "name": "all", "about": "has \"all\" keys", "dimension": 3, /* another */
  "particle_radius": 0.02, "gravity": [0.1, -9, 0.2],
  "domain": {"min": [0, -1, 0], "max": [4, 3, 2], "periodic": [false, false, true],
             "walls": {"x-": "no-slip", "x+": "open", "y+": {"kind": "no-slip", "velocity": [1, 0, 0.5]}}},
  "fluid": [
    {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "velocity": [1, 2, 3]},
    {"sphere": {"centre": [2, 1, 1], "radius": 0.3}, "velocity": {"field": "taylor_green", "speed": 2}},
    {"cylinder": {"from": [3, 0, 1], "to": [3, 1, 1], "radius": 0.2}, "velocity": {"field": "rotation", "centre": [3, 0, 1], "rate": [0, 2, 0]}},
    {"box": {"min": [3.3, 0, 0], "max": [3.8, 1, 1]}, "velocity": {"field": "shear_wave"}},
    {"box": {"min": [2.7, 0, 0], "max": [2.9, 1, 1]}, "velocity": {"field": "gresho_chan", "centre": [3, 0, 1]}},
    {"box": {"min": [2.9, 0, 1.5], "max": [3.5, 1, 2]}, "velocity": {"field": "lamb_oseen", "centre": [3, 0, 1], "radius": 0.1, "circulation": -2}}
  ],
  "bodies": [
    {"name": "rock", "mesh": {"file": "../meshes/rock.obj", "scale": 0.2, "translation": [1.5, 0, 1], "rotation": [0, 30, 0]}, "wall": "no-slip"},
    {"plane": {"point": [0, -0.5, 0], "normal": [0.1, 1, 0]}},
    {"name": "hill", "heightfield": {"formula": "0.1*x", "min": [2, -1, 0], "max": [4, 0, 2]}},
    {"name": "ball", "sphere": {"centre": [1, 1, 1], "radius": 0.1},
     "motion": [{"time": -1, "at": [0, 0.1, 0]}, {"time": 0.5, "at": [1, 0, 0.25]}, {"time": 2.5, "at": [2, -1, 0.5]}]}
  ],
  "probes": [
    {"name": "p 1", "pressure": {"at": [0, -1, 2]}},
    {"velocity": {"from": [0, 0, 0], "to": [4, 0, 1], "points": 41}, "every": 0.01},
    {"name": "gauge_2", "water_height": {"at": [3, 0.5]}},
    {"water_height": {"from": [0, 0.5], "to": [4, 0.5], "points": 5}}
  ],
  "parameters": {"viscosity.nu": 0.01, "pressure.two_sided": true, "viscosity.form": "vector", "pressure.max_iterations": 50},
  "camera": {"position": [1, 2, 3], "target": [0, 0, 0], "field_of_view": 50},
  "look": {"colour_by": "speed", "colour_map": "magma", "range": [0, 5], "background": "dark",
           "cut": {"axis": "z", "at": 0.7, "keep": "high"},
           "show_walls": false, "show_legend": false, "show_floor": false}
})json";

const std::filesystem::path scene_file = CURLEW_ASSETS_DIR "/scenes/test.json";  // need not exist

}  // namespace

TEST_CASE("every key arrives in the scene", "[scene]") {
  const Scene scene = parse_scene(full_scene, scene_file);
  CHECK(scene.name == "all");
  CHECK(scene.about == "has \"all\" keys");
  CHECK(scene.file == scene_file);
  CHECK(scene.particle_radius == 0.02);
  CHECK(scene.gravity == Vec3d{0.1, -9, 0.2});
  CHECK(scene.domain.min == Vec3d{0, -1, 0});
  CHECK(scene.domain.periodic == std::array{false, false, true});
  CHECK(scene.domain.walls[0].kind == WallKind::no_slip);
  CHECK(scene.domain.walls[1].kind == WallKind::open);
  CHECK(scene.domain.walls[2].kind == WallKind::slip);
  CHECK(scene.domain.walls[3].velocity == Vec3d{1, 0, 0.5});
  REQUIRE(scene.fluid.size() == 6);
  CHECK(scene.fluid[0].velocity.value == Vec3d{1, 2, 3});
  CHECK(std::get<Sphere>(scene.fluid[1].shape).radius == 0.3);
  CHECK(scene.fluid[1].velocity.field == InitialVelocity::Field::taylor_green);
  CHECK(scene.fluid[1].velocity.speed == 2);
  CHECK(scene.fluid[2].velocity.rate == Vec3d{0, 2, 0});
  CHECK(scene.fluid[3].velocity.speed == 1);
  CHECK(scene.fluid[4].velocity.field == InitialVelocity::Field::gresho_chan);
  CHECK(scene.fluid[4].velocity.radius == 0.2);
  CHECK(scene.fluid[4].velocity.speed == 1);
  CHECK(scene.fluid[5].velocity.field == InitialVelocity::Field::lamb_oseen);
  CHECK(scene.fluid[5].velocity.centre == Vec3d{3, 0, 1});
  CHECK(scene.fluid[5].velocity.radius == 0.1);
  CHECK(scene.fluid[5].velocity.circulation == -2);
  REQUIRE(scene.bodies.size() == 4);
  CHECK(scene.bodies[0].kind == WallKind::no_slip);
  CHECK(std::get<Mesh>(scene.bodies[0].shape).mesh->triangles.size() == 320);
  CHECK(scene.bodies[1].name == "body 2");
  CHECK(std::get<Heightfield>(scene.bodies[2].shape).heights.size() == 257 * 257);
  CHECK_FALSE(scene.bodies[2].motion.moves());
  REQUIRE(scene.bodies[3].motion.keyframes().size() == 3);
  CHECK(scene.bodies[3].motion.keyframes()[0] == Keyframe{-1, {0, 0.1, 0}});
  CHECK(scene.bodies[3].motion.keyframes()[2] == Keyframe{2.5, {2, -1, 0.5}});
  REQUIRE(scene.probes.size() == 4);
  CHECK(scene.probes[0].name == "p 1");
  CHECK(scene.probes[0].quantity == Probe::Quantity::pressure);
  CHECK(scene.probes[0].at(0) == Vec3d{0, -1, 2});
  CHECK(scene.probes[0].every == 0);
  CHECK(scene.probes[1].name == "probe 2");
  CHECK(scene.probes[1].points == 41);
  CHECK(scene.probes[1].every == 0.01);
  CHECK(scene.probes[1].at(10) == Vec3d{1, 0, 0.25});
  CHECK(scene.probes[1].at(40) == Vec3d{4, 0, 1});
  CHECK(scene.probes[2].quantity == Probe::Quantity::water_height);
  CHECK(scene.probes[2].at(0) == Vec3d{3, 0, 0.5});
  CHECK(scene.probes[3].to == Vec3d{4, 0, 0.5});
  CHECK(scene.parameters.viscosity.nu == 0.01);
  CHECK(scene.parameters.pressure.two_sided);
  CHECK(scene.parameters.viscosity.form == ViscosityParameters::form_t::vector);
  CHECK(scene.parameters.pressure.max_iterations == 50);
  CHECK(scene.camera.position == Vec3d{1, 2, 3});
  CHECK(scene.camera.field_of_view == 50);
  CHECK(scene.look.range == std::array{0.0, 5.0});
  CHECK_FALSE(scene.look.show_floor);
  REQUIRE(scene.look.cut.has_value());
  CHECK(scene.look.cut->axis == 2);
  CHECK(scene.look.cut->at == 0.7);
  CHECK(scene.look.cut->keep_high);
}

TEST_CASE("what is left out has its default", "[scene]") {
  const Scene scene = parse_scene(R"json({"curlew": 1, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
                                         "fluid": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}]})json",
                                  "some/where.json");
  CHECK(scene.name == "where");
  CHECK(scene.dimension == 3);
  CHECK(scene.gravity == Vec3d{0, -9.81, 0});
  CHECK(scene.particle_radius == 0.025);
  CHECK(scene.fluid[0].velocity.value == Vec3d{});
  CHECK(scene.domain.walls[0].kind == WallKind::slip);
  CHECK_FALSE(scene.camera.position.has_value());
  CHECK_FALSE(scene.look.range.has_value());
  CHECK_FALSE(scene.look.cut.has_value());
  CHECK(scene.probes.empty());
}

TEST_CASE("a scene in 2D has two numbers to a vector", "[scene]") {
  const Scene scene = parse_scene(
      R"json({"curlew": 1, "dimension": 2, "domain": {"min": [0, 0], "max": [1, 1], "walls": {"y+": "open"}},
      "gravity": [0, -1], "probes": [{"water_height": {"at": [0.5]}}, {"velocity": {"at": [0.5, 1]}}],
      "fluid": [{"box": {"min": [0, 0], "max": [1, 1]},
      "velocity": {"field": "rotation", "centre": [0.5, 0.5], "rate": 3}}]})json",
      "flat.json");
  CHECK(scene.fluid[0].velocity.rate == Vec3d{0, 0, 3});
  CHECK(scene.domain.max == Vec3d{1, 1, 0});
  REQUIRE(scene.probes.size() == 2);
  CHECK(scene.probes[0].from == Vec3d{0.5, 0, 0});
  CHECK(scene.probes[1].from == Vec3d{0.5, 1, 0});
  const std::string text = scene_json(scene);
  CHECK(scene_json(parse_scene(text, "flat.json")) == text);
}

TEST_CASE("the written scene reads back the same from any folder", "[scene]") {
  const Scene scene = parse_scene(full_scene, scene_file);
  const std::string text = scene_json(scene);
  const Scene again = parse_scene(text, "/somewhere/else/checkpoint");
  CHECK(scene_json(again) == text);
  CHECK(again.parameters.viscosity.nu == scene.parameters.viscosity.nu);
  const auto& mesh = *std::get<Mesh>(scene.bodies[0].shape).mesh;
  const auto& mesh_again = *std::get<Mesh>(again.bodies[0].shape).mesh;
  CHECK(mesh.vertices == mesh_again.vertices);
  CHECK(again.bodies[3].motion.keyframes() == scene.bodies[3].motion.keyframes());
  REQUIRE(again.probes.size() == scene.probes.size());
  for (std::size_t k = 0; k < scene.probes.size(); ++k) {
    const Probe &was = scene.probes[k], &is = again.probes[k];
    CHECK(std::tie(is.name, is.quantity, is.from, is.to, is.points, is.every) ==
          std::tie(was.name, was.quantity, was.from, was.to, was.points, was.every));
  }
  const auto before = sample_fluid(scene), after = sample_fluid(again);
  CHECK(before.position == after.position);
  CHECK(before.velocity == after.velocity);
  for (const ParameterRow& row : parameter_table()) {
    INFO(row.key);
    CHECK(row.get(again.parameters) == row.get(scene.parameters));
    CHECK(text.find("\"" + row.key + "\"") != std::string::npos);
  }
}

TEST_CASE("the round trip also works for a scene with a relative path", "[scene]") {
  const auto folder = std::filesystem::current_path();
  std::filesystem::current_path(CURLEW_SOURCE_DIR);
  const std::string text = scene_json(read_scene("assets/scenes/rock.json"));
  std::filesystem::current_path(std::filesystem::temp_directory_path());
  CHECK(scene_json(parse_scene(text, "elsewhere.json")) == text);
  std::filesystem::current_path(folder);
}

TEST_CASE("numbers of every size survive the round trip", "[scene]") {
  Scene scene = parse_scene(full_scene, scene_file);
  for (const double radius : {1.0 / 58, 0.1, 1e-9, 123.456, 1.0 / 3}) {
    scene.particle_radius = radius;
    CHECK(parse_scene(scene_json(scene), scene_file).particle_radius == radius);
  }
  scene.name = "quote \" slash \\ line \n ümlaut \x01";
  CHECK(parse_scene(scene_json(scene), scene_file).name == scene.name);
}
