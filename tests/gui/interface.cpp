// What a hand does with the window, without a display: every panel, slider, button and key.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "app/gui/plot.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "tests/gui/desk.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

// A scene that is laid out and stepped in no time.
constexpr const char* small = CURLEW_ASSETS_DIR "/scenes/dam_break_2d.json";

bool in_turbulence(const ParameterRow& row) {
  const auto keys = turbulence_keys();
  return std::find(keys.begin(), keys.end(), row.key) != keys.end();
}

int colours_in(const Image& image, std::array<float, 4> box) {
  std::set<std::uint32_t> found;
  for (int y = static_cast<int>(box[1]); y < static_cast<int>(box[3]); ++y) {
    for (int x = static_cast<int>(box[0]); x < static_cast<int>(box[2]); ++x) {
      const auto* p = image.at(x, y);
      found.insert(static_cast<std::uint32_t>(p[0] << 16 | p[1] << 8 | p[2]));
    }
  }
  return static_cast<int>(found.size());
}

bool overlap(std::array<float, 4> a, std::array<float, 4> b) {
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

}  // namespace

TEST_CASE("a slider that is dragged changes what the solver reads, and undo takes it back") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  const double before = desk.parameters.viscosity.nu;
  desk.drag("viscosity.nu", 0.05f, 0.6f);
  desk.settle();
  CHECK(desk.parameters.viscosity.nu == Approx(0.03).epsilon(0.1));  // 0.6 of a slider to 0.05
  desk.click("step");
  desk.settle();
  CHECK(desk.interface().samples().size() == 1);
  CHECK(desk.interface().command_line().find("--set viscosity.nu=0.0") != std::string::npos);
  desk.key('Z', true);
  desk.settle();
  CHECK(desk.parameters.viscosity.nu == before);
  desk.key('Y', true);
  desk.settle();
  CHECK(desk.parameters.viscosity.nu == Approx(0.03).epsilon(0.1));
  desk.double_click("label viscosity.nu");
  desk.settle();
  CHECK(desk.parameters.viscosity.nu == before);
}

TEST_CASE("play, pause, step and reset, by mouse and by key") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  desk.click("step");
  desk.key('S');
  desk.settle();
  CHECK(desk.interface().status().step == 2);
  desk.click("play");
  for (int k = 0; k < 5000 && desk.interface().status().step < 10; ++k) desk.draw();
  CHECK(desk.interface().status().state == RunState::playing);
  CHECK(desk.interface().status().step >= 10);
  desk.key(' ');
  desk.settle();
  CHECK(desk.interface().status().state == RunState::paused);
  desk.click("reset");
  desk.settle();
  CHECK(desk.interface().status().step == 0);
  CHECK(desk.interface().samples().empty());
}

TEST_CASE("another scene is picked from the list") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  desk.click("scene");
  desk.draw();
  desk.wheel(-60);  // the last one of a list that is longer than the window may be
  desk.draw();
  desk.click("scene taylor_green");
  desk.settle();
  CHECK(desk.interface().scene().name == "Taylor-Green vortices in 2D");
  CHECK(desk.interface().status().particles == 2500);
  CHECK(desk.interface().frame()->geometry->dimension == 2);
}

TEST_CASE("the view turns, moves, zooms, and comes back") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open("free_fall");
  const Vec3d before = *desk.interface().view().camera.position;
  desk.drag_in_picture(100, 20);
  const Vec3d turned = *desk.interface().view().camera.position;
  CHECK(length(turned - before) > 0.1);
  desk.drag_in_picture(50, 30, 1);
  CHECK(length(*desk.interface().view().camera.position - turned) > 0.01);
  const double distance = length(*desk.interface().view().camera.position - *desk.interface().view().camera.target);
  desk.wheel(3);
  CHECK(length(*desk.interface().view().camera.position - *desk.interface().view().camera.target) < 0.8 * distance);
  desk.click("Scene's");
  CHECK(length(*desk.interface().view().camera.position - before) < 1e-9);
  desk.key('5');
  const auto& camera = desk.interface().view().camera;
  CHECK(camera.position->y - camera.target->y > 10 * std::abs(camera.position->x - camera.target->x));
}

TEST_CASE("colours, cut and drop size change the picture") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open("free_fall");
  const auto all = desk.interface().frame()->position.size();
  desk.click("cut");
  desk.settle();
  const auto half = desk.interface().frame()->position.size();
  CHECK(half > all / 4);
  CHECK(half < 3 * all / 4);
  desk.drag("cut at", 0.35f, 0.3f);
  desk.settle();
  CHECK(desk.interface().frame()->position.size() < half);
  desk.click("cut");
  desk.drag("drop size", 0.6f, 0.1f);
  CHECK(desk.interface().view().particle_scale.value_or(1) < 0.8);
  desk.click("legend");
  CHECK(!desk.interface().view().look.show_legend);
}

TEST_CASE("pictures and films are asked for, checkpoints, scenes and plots are written") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  desk.click("step");
  desk.settle();
  desk.click("Picture");
  CHECK(desk.requests.screenshot);
  CHECK(!desk.requests.with_interface);
  desk.click("Window");
  CHECK(desk.requests.with_interface);
  desk.click("Film");
  CHECK(desk.requests.start_recording);
  CHECK(!desk.requests.as_frames);
  desk.click("Frames");
  CHECK(desk.requests.start_recording);
  CHECK(desk.requests.as_frames);

  desk.click("Checkpoint");
  desk.settle();
  CHECK(std::filesystem::exists(folder / "dam_break_2d/checkpoint_000.curlew"));
  desk.drag("viscosity.nu", 0.05f, 0.6f);
  desk.settle();
  desk.click("Save");
  const Scene saved = read_scene(folder / "dam_break_2d/scene_000.json");
  CHECK(saved.parameters.viscosity.nu == desk.parameters.viscosity.nu);
  desk.click("Energy.csv");
  const std::string csv = file_text(folder / "dam_break_2d/energy_000.csv");
  CHECK(csv.starts_with("step,time (s),total (J),kinetic (J),potential (J)\n1,"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 2);
}

TEST_CASE("what is wrong is said, and the run stays") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  put_file(folder / "bad.json", "{\"curlew\": 1, \"name\": ");
  desk.open(folder / "bad.json");
  CHECK(desk.interface().message().find("bad.json") != std::string::npos);
  CHECK(desk.interface().scene().name == "Dam break in 2D");
  desk.open(folder / "nowhere.json");
  CHECK(desk.interface().message().find("nowhere.json") != std::string::npos);
  desk.keep("error");
  desk.click("OK");
  CHECK(desk.interface().message().empty());
}

TEST_CASE("a run that diverged offers to go on with half the time step") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  put_file(folder / "wild.json", R"({"curlew": 1, "name": "Wild", "dimension": 2, "particle_radius": 0.02,
    "domain": {"min": [0, 0], "max": [2, 2]}, "fluid": [{"box": {"min": [0, 0], "max": [1, 1]}}],
    "parameters": {"time.fixed_step": 0.3}})");
  desk.open(folder / "wild.json");
  desk.click("play");
  for (int k = 0; k < 500 && desk.interface().status().state != RunState::diverged; ++k) desk.draw();
  REQUIRE(desk.interface().status().state == RunState::diverged);
  desk.draw();
  desk.draw();
  CHECK(desk.interface().message().starts_with("the simulation diverged at step "));
  desk.keep("diverged");
  desk.click("Go on with half the time step");
  desk.settle();
  CHECK(desk.parameters.time.fixed_step == 0.15);
}

TEST_CASE("every panel is drawn, at both themes and sizes, and nothing lies on anything") {
  const double scale = GENERATE(1.0, 2.0);
  const TemporaryFolder folder;
  Desk desk(folder.path(), static_cast<int>(1280 * scale), static_cast<int>(720 * scale), scale);
  desk.open("free_fall");
  desk.click("play");
  for (int k = 0; k < 300 && desk.interface().status().step < 20; ++k) desk.draw();
  desk.click("play");
  desk.settle();
  desk.move_to(1, 1);
  desk.keep("window_" + std::to_string(static_cast<int>(scale)));
  const Image light = desk.picture();
  for (const char* widget : {"picture", "plot Energy", "plot Compression", "plot Iterations", "plot Time step",
                             "plot Cost of a step", "viscosity.nu", "colour by", "status"}) {
    INFO(widget);
    CHECK(colours_in(light, desk.interface().place(widget)) > 10);
  }
  const char* apart[] = {"scene",
                         "play",
                         "step",
                         "reset",
                         "Picture",
                         "Window",
                         "Film",
                         "Frames",
                         "show parameters",
                         "show view",
                         "show plots",
                         "Help",
                         "Undo",
                         "Redo",
                         "Load",
                         "Save",
                         "viscosity.nu",
                         "sub_particles.levels",
                         "label viscosity.nu",
                         "look",
                         "colour by",
                         "map",
                         "bodies",
                         "legend",
                         "drop size",
                         "cut",
                         "front",
                         "left",
                         "corner",
                         "hold plots",
                         "Energy.csv",
                         "plot Energy",
                         "plot Compression",
                         "status"};
  for (const char* a : apart) {
    for (const char* b : apart) {
      if (a == b) continue;
      INFO(a << " and " << b);
      CHECK(!overlap(desk.interface().place(a), desk.interface().place(b)));
    }
  }
  desk.click("dark");
  CHECK(desk.requests.restyle);
  desk.restyle(true, scale);
  desk.click("Help");
  desk.draw();
  desk.keep("dark_help_" + std::to_string(static_cast<int>(scale)));
  const Image dark = desk.picture();
  CHECK(dark.at(5, 5)[0] < 80);
  CHECK(light.at(5, 5)[0] > 200);
  desk.click("show parameters");
  desk.click("show view");
  desk.click("show plots");
  desk.draw();
  CHECK(desk.interface().picture_size()[0] == static_cast<int>(1280 * scale));
}

TEST_CASE("another number of particles, and parameters that wait for a layout") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  desk.click("Scene file");
  desk.click("Turbulence");
  desk.click("group sph");
  const auto before = desk.interface().status();
  desk.type("particles", "1000");
  CHECK(desk.interface().status().scene_number == before.scene_number);
  desk.click("Apply");
  desk.settle();
  CHECK(desk.interface().status().scene_number == before.scene_number + 1);
  CHECK(std::abs(static_cast<double>(desk.interface().status().particles) - 1000) < 60);
  CHECK(desk.interface().scene().particle_radius > 1.5 * before.particle_radius);
  CHECK(desk.interface().command_line().find("--radius") != std::string::npos);

  const double read = desk.parameters.sph.h_over_d;
  CHECK_THROWS(desk.interface().place("Apply waiting"));
  desk.drag("sph.h_over_d", 0.2f, 0.6f);
  desk.settle();
  const double set = desk.interface().scene().parameters.sph.h_over_d;
  CHECK(set > read);
  CHECK(desk.parameters.sph.h_over_d == read);
  desk.click("Apply waiting");
  desk.settle();
  CHECK(desk.parameters.sph.h_over_d == set);
  CHECK(desk.interface().status().scene_number == before.scene_number + 2);
  CHECK_THROWS(desk.interface().place("Apply waiting"));

  desk.type("particles", "0");
  desk.click("Apply");
  CHECK(desk.interface().message() == "The number of particles has to be at least 1");
}

TEST_CASE("a slider that moves while a scene is laid out counts for the one that comes") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  desk.click("reset");
  desk.drag("viscosity.nu", 0.05f, 0.6f);
  desk.settle();
  CHECK(desk.interface().scene().parameters.viscosity.nu > 0);
  CHECK(desk.parameters.viscosity.nu == desk.interface().scene().parameters.viscosity.nu);
  // But not for another scene.
  desk.interface().open("free_fall");
  desk.drag("viscosity.nu", 0.6f, 0.8f);
  desk.settle();
  CHECK(desk.parameters.viscosity.nu == desk.interface().scene().parameters.viscosity.nu);
  CHECK(desk.interface().scene().parameters.viscosity.nu == 0);
}

TEST_CASE("no name of a parameter is cut off, in any group, in small and large windows") {
  // What is cut off depends on the width; the height is such that no group has to be scrolled to.
  const auto& [width, height, scale] = GENERATE(std::tuple{1280, 720, 1.0}, std::tuple{1280, 720, 1.25},
                                                std::tuple{1280, 1000, 2.0}, std::tuple{2560, 1440, 2.0});
  const TemporaryFolder folder;
  Desk desk(folder.path(), width, height, scale);
  desk.open(small);
  desk.click("show plots");
  for (const char* group : {"Scene file", "Turbulence", "group viscosity", "group micropolar", "group time"}) {
    desk.click(group);
  }
  // Groups are open one at a time: all of their rows are in the window then.
  std::vector<std::string> groups;
  for (const ParameterRow& row : parameter_table()) {
    const std::string group = in_turbulence(row) ? "Turbulence" : "group " + row.group;
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  for (const std::string& group : groups) {
    desk.click(group);
    for (const ParameterRow& row : parameter_table()) {
      if ((in_turbulence(row) ? "Turbulence" : "group " + row.group) != group) continue;
      INFO(row.key << " at " << width << "x" << height << " and " << scale);
      const auto label = desk.interface().place("label " + row.key), slider = desk.interface().place(row.key);
      CHECK(label[0] >= slider[2]);
      // Before the scroll bar, and with room for the mark of a change.
      CHECK(label[2] <= desk.interface().place("picture")[0] - static_cast<float>(32 * scale));
    }
    desk.click(group);
  }
}

TEST_CASE("a number that is typed counts when it is done") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  const double before = desk.parameters.viscosity.nu;
  desk.type("viscosity.nu", "0.0375");
  desk.settle();
  CHECK(desk.parameters.viscosity.nu == before);
  desk.click("picture");
  desk.settle();
  CHECK(desk.parameters.viscosity.nu == 0.0375);
  desk.type("viscosity.nu", "2000");  // beyond the hard limit
  desk.click("picture");
  desk.settle();
  CHECK(desk.interface().message().find("viscosity.nu is 2000, expected a number from 0 to 100") != std::string::npos);
  CHECK(desk.parameters.viscosity.nu == 0.0375);
}

TEST_CASE("the widgets speak of the run that is there until another one stands") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open(small);
  const Scene own = read_scene(CURLEW_ASSETS_DIR "/scenes/dam_break.json");
  desk.interface().open("dam_break", with_particles(own, 30000), own);
  CHECK(desk.interface().scene().name == "Dam break in 2D");
  for (int k = 0; k < 2000 && desk.interface().scene().name != "Dam break"; ++k) desk.draw();
  REQUIRE(desk.interface().scene().name == "Dam break");
  desk.settle();
  CHECK(length(*desk.interface().view().camera.position - *own.camera.position) < 1e-9);
  const double height = desk.interface().view().camera.position->y;
  desk.drag_in_picture(0, 60);
  CHECK(desk.interface().view().camera.position->y > height + 0.1);  // it turns: this is 3D

  const std::string command = desk.interface().command_line();
  desk.interface().open("free_fall");
  desk.session.cancel();
  desk.settle();
  CHECK(desk.interface().scene().name == "Dam break");
  CHECK(desk.interface().command_line() == command);
}

TEST_CASE("a colour scale forgets the field before") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open("free_fall");
  for (const char* field : {"pressure", "density", "speed"}) {
    desk.click("colour by");
    desk.draw();
    desk.click(std::string("colour by ") + field);
    desk.settle();
  }
  CHECK((*desk.interface().view().look.range)[1] < 100);  // m/s, not Pa
}

TEST_CASE("the look of the water is chosen, and its surface comes with the frames") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  desk.open("free_fall");
  CHECK(desk.interface().frame()->surface == nullptr);
  const auto choose_look = [&](const std::string& name) {
    desk.click("look");
    desk.draw();
    desk.click("look " + name);
  };
  choose_look("water");
  desk.settle();
  CHECK(desk.interface().view().look.style == LookStyle::water);
  REQUIRE(desk.interface().frame()->surface != nullptr);
  const std::size_t fine = desk.interface().frame()->surface->triangles.size();
  desk.session.set_parameters([&] {
    Parameters p = desk.parameters;
    p.surface.cell = 2;
    return p;
  }());
  desk.settle();
  CHECK(desk.interface().frame()->surface->triangles.size() < fine / 2);
  desk.click("step");
  desk.settle();
  CHECK(desk.interface().frame()->surface != nullptr);
  desk.keep("water");
  choose_look("fast-water");
  desk.settle();
  CHECK(desk.interface().frame()->surface == nullptr);
  CHECK(desk.interface().frame()->value.empty());
  choose_look("particles");
  desk.settle();
  CHECK_FALSE(desk.interface().frame()->value.empty());
}

TEST_CASE("saving does not replace what it has not written") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  const std::string mine = folder / "mine.json";
  std::filesystem::copy(small, mine);
  desk.open(mine);
  const std::string before = file_text(mine);
  desk.type("file", mine.c_str());
  desk.click("Save");
  CHECK(file_text(mine) == before);
  CHECK(desk.interface().message().find("is there already") != std::string::npos);
}

// Not a test: where the widgets of a new window are, for real_window.sh, one a line: left, top, right, bottom, name.
TEST_CASE("places of the widgets", "[.places]") {
  const TemporaryFolder folder;
  const auto print = [](Desk& desk, std::initializer_list<const char*> widgets) {
    for (const char* widget : widgets) {
      const auto box = desk.interface().place(widget);
      std::printf("place %g %g %g %g %s\n", double{box[0]}, double{box[1]}, double{box[2]}, double{box[3]}, widget);
    }
  };
  {
    Desk desk(folder.path());
    desk.open(small);
    desk.draw();
    desk.click("scene");
    desk.draw();
    print(desk, {"scene", "play", "step", "reset", "Picture", "Window", "Film", "Checkpoint", "Frames", "show plots",
                 "viscosity.nu", "Energy.csv", "Time step.csv", "picture", "scene free_fall"});
  }
  // The end of the list of parameters, with the plots out of its way.
  Desk desk(folder.path());
  desk.open(small);
  desk.click("show plots");
  desk.wheel_at(70, 300, -100);
  print(desk, {"time.cfl"});
}

// Not a test: pictures of every group of the panels, to be looked at (CURLEW_KEEP_WINDOWS says where).
TEST_CASE("pictures of every group", "[.panels]") {
  const TemporaryFolder folder;
  for (const auto& [width, height, scale] : {std::tuple{1280, 720, 1.0}, {2560, 1440, 2.0}, {1280, 720, 2.0}}) {
    Desk desk(folder.path(), width, height, scale);
    desk.open(small);
    desk.click("step");
    desk.settle();
    const std::string suffix = "_" + std::to_string(width) + "_" + std::to_string(static_cast<int>(scale)) + "x";
    desk.click("show plots");
    desk.keep("all" + suffix);
    for (const char* group : {"Scene file", "Turbulence", "group viscosity", "group micropolar", "group time"}) {
      desk.click(group);
    }
    std::set<std::string> groups;
    for (const ParameterRow& row : parameter_table()) {
      if (!in_turbulence(row)) groups.insert("group " + row.group);
    }
    groups.insert({"Scene file", "Turbulence"});
    for (const std::string& group : groups) {
      desk.click(group);
      desk.keep(group + suffix);
      desk.click(group);
    }
    desk.click("Turbulence");
    desk.click("dark");
    desk.restyle(true, scale);
    for (const std::string widget : {"preset", "vorticity_refinement.alpha", "micropolar.nu_t", "colour by"}) {
      const auto box = desk.interface().place(widget);
      desk.move_to(box[2] - 2, 0.5f * (box[1] + box[3]));
      desk.keep("dark tip " + widget + suffix);
    }
    desk.click("dark");
    desk.restyle(false, scale);
    for (const std::string widget : {"preset", "colour by"}) {
      desk.click(widget);
      const std::string entry = widget == "preset" ? "preset VR with MP" : "colour by lost_vorticity";
      const auto box = desk.interface().place(entry);
      desk.move_to(0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3]));
      desk.keep(widget + " open" + suffix);
      desk.click(entry);
      desk.click("step");
      desk.settle();
      desk.keep(entry + suffix);
    }
    desk.click("show plots");
    for (int k = 0; k < 15; ++k) desk.click("step");
    desk.settle();
    desk.keep("plots" + suffix);
    desk.click("show plots");
    desk.click("Undo");
    desk.settle();
    desk.keep("colour of a model that is off" + suffix);
    desk.click("Turbulence");
    desk.click("scene");
    desk.keep("scenes" + suffix);
    desk.key(256);
    desk.click("Help");
    desk.keep("help" + suffix);
  }
}

// Not a test: how long a picture of the interface takes, and one of the water, while 20,000 particles run.
TEST_CASE("time of a picture", "[.time]") {
  const TemporaryFolder folder;
  Desk desk(folder.path());
  const Scene own = read_scene(CURLEW_ASSETS_DIR "/scenes/dam_break.json");
  desk.interface().open("dam_break", with_particles(own, 20000), own);
  desk.settle();
  for (const bool playing : {false, true}) {
    desk.session.play(playing);
    std::vector<double> interface, water;
    for (int k = 0; k < 100; ++k) {
      const auto version = desk.interface().version();
      const auto begin = std::chrono::steady_clock::now();
      desk.draw();
      glFinish();
      const double ms = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      (desk.interface().version() == version ? interface : water).push_back(ms);
    }
    desk.session.play(false);
    const auto median = [](std::vector<double> v) {
      std::sort(v.begin(), v.end());
      return v.empty() ? 0.0 : v[v.size() / 2];
    };
    std::printf("%s: %.1f ms a picture of the interface (%zu), %.1f ms with the water anew (%zu)\n",
                playing ? "playing" : "paused", median(interface), interface.size(), median(water), water.size());
  }
}
