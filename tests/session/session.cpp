// The run on its own thread: it does what it is told, in order, and ends where a run without a window ends.
#include "app/session.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "sim/io/checkpoint.h"
#include "sim/measure/state_hash.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

Scene small_scene(int particles = 1000) {
  return with_particles(read_scene(CURLEW_ASSETS_DIR "/scenes/dam_break.json"), particles);
}

std::string hash_without_window(const Scene& scene, std::int64_t steps) {
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  while (world.step < steps) step(world, plan);
  return hash_text(state_hash(world.fields));
}

// Polls until the condition holds; fails the test where it never does.
template <class Condition>
Session::Update poll_until(Session& session, Condition&& condition) {
  for (int k = 0; k < 2000; ++k) {
    Session::Update update = session.poll();
    if (condition(update)) return update;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL("waited 10 s in vain");
  return {};
}

void open(Session& session, const Scene& scene) {
  session.open(scene);
  session.finish_tasks();
}

}  // namespace

TEST_CASE("a session steps to the same bits as a run without a window") {
  const Scene scene = small_scene();
  Session session;
  open(session, scene);
  for (int k = 0; k < 20; ++k) session.step_once();
  CHECK(session.state_hash() == hash_without_window(scene, 20));
}

TEST_CASE("looking does not change what is seen") {
  const Scene scene = small_scene();
  Session session;
  open(session, scene);
  session.colour_by("vorticity");  // a pass that only frames need
  for (int k = 0; k < 10; ++k) {
    session.step_once();
    session.finish_tasks();
    const auto update = session.poll();
    REQUIRE(update.frame);
    CHECK(update.frame->value.size() == update.frame->position.size());
    CHECK(update.frame->step == k + 1);
  }
  session.colour_by("pressure");
  session.step_once();
  CHECK(session.state_hash() == hash_without_window(scene, 11));
}

TEST_CASE("looking at what turbulence models do changes no bit, while they are on and while they are off") {
  Scene scene = small_scene(500);
  for (const bool on : {false, true}) {
    scene.parameters.micropolar.nu_t = on ? 0.05 : 0;
    scene.parameters.vorticity_refinement.alpha = on ? 1 : 0;
    Session session;
    open(session, scene);
    for (const char* colour : {"microrotation", "lost_vorticity"}) {
      session.colour_by(colour);
      for (int k = 0; k < 5; ++k) session.step_once();
      session.finish_tasks();
      const auto update = session.poll();
      REQUIRE(update.frame);
      const auto& values = update.frame->value;
      REQUIRE(values.size() == update.frame->position.size());
      CHECK(std::any_of(values.begin(), values.end(), [](float v) { return v != 0; }) == on);
    }
    CHECK(session.state_hash() == hash_without_window(scene, 10));
  }
}

TEST_CASE("play, pause, and samples of every step") {
  Session session;
  open(session, small_scene(500));
  std::vector<Sample> samples;
  session.play(true);
  poll_until(session, [&](const Session::Update& update) {
    samples.insert(samples.end(), update.samples.begin(), update.samples.end());
    return samples.size() >= 30;
  });
  session.play(false);
  session.finish_tasks();
  const auto last = session.poll();
  samples.insert(samples.end(), last.samples.begin(), last.samples.end());
  CHECK(last.status.state == RunState::paused);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    CHECK(samples[k].step == static_cast<std::int64_t>(k) + 1);
    CHECK(samples[k].kinetic > 0);
    CHECK(samples[k].ms_step > 0);
  }
  const std::string hash = session.state_hash();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  CHECK(session.state_hash() == hash);  // paused is paused
}

TEST_CASE("live parameters count from the next step, others from the next layout") {
  Session session;
  open(session, small_scene(500));
  Parameters wanted = session.poll().parameters;
  wanted.time.fixed_step = 1e-4;
  wanted.sph.rest_density = 500;
  session.set_parameters(wanted);
  session.step_once();
  session.finish_tasks();
  const auto update = session.poll();
  REQUIRE(update.samples.size() == 1);
  CHECK(update.samples[0].dt == 1e-4);
  CHECK(update.parameters.time.fixed_step == 1e-4);
  CHECK(update.parameters.sph.rest_density == 1000);
}

TEST_CASE("a pass that is switched on later finds what it reads") {
  Session session;
  open(session, small_scene(500));
  session.step_once();
  session.finish_tasks();
  Parameters wanted = session.poll().parameters;
  wanted.pressure.two_sided = true;
  wanted.viscosity.nu = 0.01;
  session.set_parameters(wanted);
  for (int k = 0; k < 5; ++k) session.step_once();
  session.finish_tasks();
  const auto update = session.poll();
  CHECK(update.status.state == RunState::paused);
  CHECK(update.status.step == 6);
  CHECK(update.messages.empty());
}

TEST_CASE("a run that diverges is paused, says why, and keeps the state before") {
  Scene scene = small_scene();
  scene.parameters.time.fixed_step = 0.3;
  Session session;
  open(session, scene);
  session.play(true);
  const auto update = poll_until(session, [](const auto& u) { return u.status.state == RunState::diverged; });
  REQUIRE(update.messages.size() == 1);
  CHECK(update.messages[0].text.starts_with("the simulation diverged at step "));
  Parameters gentler = scene.parameters;
  gentler.time.fixed_step = 1e-3;
  session.set_parameters(gentler);
  const std::int64_t before = update.status.step;
  session.play(true);
  poll_until(session, [&](const auto& u) { return u.status.step > before + 5; });
}

TEST_CASE("a scene that cannot be laid out leaves the run that is there") {
  Session session;
  const Scene scene = small_scene(500);
  open(session, scene);
  session.step_once();
  const std::string hash = session.state_hash();
  Scene empty = scene;
  empty.fluid[0].shape = Box{{5, 5, 5}, {6, 6, 6}};
  session.poll();
  open(session, empty);
  const auto update = session.poll();
  REQUIRE(update.messages.size() == 1);
  CHECK(update.messages[0].text.find("holds no particle") != std::string::npos);
  CHECK(session.state_hash() == hash);
}

TEST_CASE("laying out can be cancelled") {
  Session session;
  open(session, small_scene(500));
  const std::string hash = session.state_hash();
  session.open(small_scene(200000));
  CHECK(session.poll().status.loading);
  session.cancel();
  session.finish_tasks();
  const auto update = session.poll();
  CHECK(!update.status.loading);
  CHECK(update.status.particles < 600);
  CHECK(session.state_hash() == hash);
}

TEST_CASE("of two layouts in a row the newest counts, and a cancelled one never comes") {
  Session session;
  open(session, small_scene(500));
  session.open(small_scene(60000));
  session.open(small_scene(1000));
  session.finish_tasks();
  auto update = session.poll();
  CHECK(update.status.particles < 1500);
  CHECK(update.status.scene_number == 2);
  session.open(small_scene(60000));
  session.cancel();
  CHECK(!session.poll().status.loading);
  session.open(small_scene(500));
  session.finish_tasks();
  update = session.poll();
  CHECK(update.status.particles < 700);
  CHECK(update.status.scene_number == 3);
}

TEST_CASE("a recording has a frame for every 1/fps, however fast it is taken") {
  Session session;
  open(session, small_scene(500));
  session.record(200);
  session.play(true);
  std::vector<double> times;
  poll_until(session, [&](const auto& u) {
    for (const auto& frame : u.recorded) times.push_back(frame->time);
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    return times.size() >= 20;
  });
  session.record(0);
  session.play(false);
  for (std::size_t k = 0; k < times.size(); ++k) {
    CHECK(times[k] >= static_cast<double>(k) / 200 * (1 - 1e-9));
    CHECK(times[k] <= static_cast<double>(k + 1) / 200 + 5e-3);
  }
}

TEST_CASE("a checkpoint of a session holds its state, and a full disk is said") {
  const TemporaryFolder folder;
  Session session;
  open(session, small_scene(500));
  for (int k = 0; k < 5; ++k) session.step_once();
  session.save_checkpoint(folder / "a.curlew");
  const std::string hash = session.state_hash();
  const Checkpoint saved = read_checkpoint(folder / "a.curlew");
  CHECK(saved.step == 5);
  CHECK(hash_text(state_hash(saved.fields)) == hash);
  session.poll();
  session.save_checkpoint("/proc/nowhere/a.curlew");
  session.finish_tasks();
  const auto update = session.poll();
  REQUIRE(update.messages.size() == 1);
  CHECK(update.messages[0].text.find("/proc/nowhere/a.curlew") != std::string::npos);
}

TEST_CASE("a session can be closed at any moment") {
  Session session;
  session.open(small_scene(20000));
  session.play(true);
}
