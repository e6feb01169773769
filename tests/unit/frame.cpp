// Colours of a frame: what a model left at each particle, and 0 where the model is off.
#include "sim/core/frame.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "sim/core/passes.h"
#include "sim/measure/state_hash.h"
#include "sim/surface/surface.h"

using namespace curlew;

namespace {

// Falls, hits and mixes, so that particles change their places in the order; some leave through the open face.
Scene splash() {
  Scene scene;
  scene.particle_radius = 0.025;
  scene.domain.max = {1, 0.6, 0.3};
  scene.domain.walls[1].kind = WallKind::open;
  scene.fluid.push_back({Box{{0.4, 0, 0}, {0.9, 0.5, 0.3}}, {}});
  return scene;
}

// What the refinement saw as lost, by particle.
struct Losses : PassObserver {
  void after(const Pass& pass, const World& world, double) override {
    if (pass.name != "vorticity_refinement") return;
    for (std::size_t i = 0; i < world.count; ++i) by_id[world.fields.id[i]] = length(world.fields.lost_vorticity[i]);
  }
  std::map<std::uint32_t, float> by_id;
};

std::uint64_t hash_after(const Scene& scene, FieldSet demanded) {
  World world = make_world(scene);
  const Plan plan = make_plan(world, demanded);
  prepare(world, plan);
  for (int k = 0; k < 30; ++k) step(world, plan);
  return state_hash(world.fields);
}

}  // namespace

TEST_CASE("each particle shows the vorticity that it lost, wherever it was sorted to", "[frame]") {
  Scene scene = splash();
  scene.parameters.vorticity_refinement.alpha = 1;
  World world = make_world(scene);
  const Plan plan = make_plan(world, colour_demand("lost_vorticity"));
  prepare(world, plan);
  const std::size_t all = world.count;
  bool sorted = false;
  for (int k = 0; k < 150; ++k) {
    Losses losses;
    step(world, plan, &losses);
    const Frame frame = make_frame(world, "lost_vorticity", make_geometry(scene));
    REQUIRE(frame.value.size() == world.count);
    bool same = true;
    for (std::size_t i = 0; i < world.count; ++i) same = same && frame.value[i] == losses.by_id.at(world.fields.id[i]);
    INFO("step " << world.step);
    REQUIRE(same);
    sorted = sorted || !std::is_sorted(world.order.begin(), world.order.end());
  }
  CHECK(sorted);
  CHECK(world.count < all);
}

TEST_CASE("colours of models that are off are 0, and those of models that are on are not", "[frame]") {
  struct Case {
    const char* colour;
    const char* key;
  };
  for (const auto& [colour, key] :
       {Case{"microrotation", "micropolar.nu_t"}, Case{"lost_vorticity", "vorticity_refinement.alpha"}}) {
    for (const double strength : {0.0, 0.5}) {
      INFO(colour << ", " << key << " = " << strength);
      Scene scene = splash();
      parameter_row(key).set(scene.parameters, strength);
      CHECK(colour_switch(colour, scene.parameters) == (strength == 0 ? key : ""));
      World world = make_world(scene);
      const Plan plan = make_plan(world, colour_demand(colour));
      prepare(world, plan);
      for (int k = 0; k < 5; ++k) step(world, plan);
      const Frame frame = make_frame(world, colour, make_geometry(scene));
      REQUIRE(frame.value.size() == world.count);
      const auto moved = std::count_if(frame.value.begin(), frame.value.end(), [](float v) { return v != 0; });
      CHECK((moved > 0) == (strength > 0));
    }
  }
}

TEST_CASE("what a frame shows changes no bit of the state", "[frame]") {
  Scene scene = splash();
  for (const bool on : {false, true}) {
    scene.parameters.vorticity_refinement.alpha = on ? 1 : 0;
    scene.parameters.micropolar.nu_t = on ? 0.05 : 0;
    const std::uint64_t plain = hash_after(scene, {});
    for (const ColourField& field : colour_fields()) {
      INFO(field.name << ", models " << (on ? "on" : "off"));
      CHECK(hash_after(scene, colour_demand(field.name)) == plain);
    }
  }
}

TEST_CASE("the full micropolar model is on with viscosity alone", "[frame]") {
  Parameters parameters;
  CHECK(colour_switch("speed", parameters).empty());
  CHECK(colour_switch("microrotation", parameters) == "micropolar.nu_t");
  parameters.micropolar.model = MicropolarParameters::model_t::full;
  parameters.viscosity.nu = 0.01;
  CHECK(colour_switch("microrotation", parameters).empty());
}

TEST_CASE("a cut keeps what lies on its side, with its colours") {
  World world = make_world(splash());
  const auto geometry = make_geometry(world.scene);
  Frame frame = make_frame(world, "speed", geometry);
  for (std::size_t i = 0; i < frame.value.size(); ++i) frame.value[i] = frame.position[i].y;
  const Frame low = cut_open(frame, {1, 0.2, false}), high = cut_open(frame, {1, 0.2, true});
  CHECK(low.position.size() + high.position.size() == frame.position.size());
  REQUIRE(low.position.size() > 100);
  REQUIRE(high.position.size() > 100);
  for (const float y : low.value) CHECK(y <= 0.2f);
  for (const float y : high.value) CHECK(y > 0.2f);
}

TEST_CASE("clear water that is cut open has its surface, flat at the cut") {
  World world = make_world(splash());
  Look look;
  look.style = LookStyle::water;
  look.cut = Cut{0, 0.6, false};
  prepare(world, make_plan(world, shown_demand(look, 3)));
  SurfaceMaker maker;
  const Frame frame = make_shown_frame(world, look, make_geometry(world.scene), maker);
  REQUIRE(frame.surface != nullptr);
  CHECK(frame.position.size() < world.count);
  float farthest = 0;
  for (const Vec3& p : frame.surface->position) farthest = std::max(farthest, p.x);
  CHECK(farthest == Approx(0.6).margin(1e-4));
  look.style = LookStyle::fast_water;
  CHECK(make_shown_frame(world, look, make_geometry(world.scene), maker).surface == nullptr);
}

TEST_CASE("a frame says where bodies are", "[frame]") {
  Scene scene = splash();
  scene.bodies.push_back({"still", Sphere{{0.2, 0.3, 0.15}, 0.05}, WallKind::slip});
  CHECK(make_frame(make_world(scene), "none", make_geometry(scene)).body_offset.empty());
  scene.bodies.push_back({"ball", Sphere{{0.2, 0.5, 0.15}, 0.05}, WallKind::slip});
  scene.bodies.back().motion = KeyframePath({{0, {}}, {0.2, {0.1, 0, 0}}});
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  while (world.time < 0.1) step(world, plan);
  const Frame frame = make_frame(world, "none", make_geometry(scene));
  REQUIRE(frame.body_offset.size() == 2);
  CHECK(frame.body_offset[0] == Vec3d{});
  CHECK(frame.body_offset[1] == scene.bodies[1].motion.at(world.time).offset);
  CHECK(frame.body_offset[1].x > 0.04);
  CHECK(cut_open(frame, {}).body_offset == frame.body_offset);
}
