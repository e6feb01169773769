// A hand that knows nothing: random clicks, drags and keys must neither crash nor hang the window, nor lose the run.
// CURLEW_MONKEY_SECONDS=60 goes on for a minute, as the sanitizers want it.
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <random>

#include "tests/gui/desk.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

TEST_CASE("random clicks, drags and keys") {
  using Clock = std::chrono::steady_clock;
  const char* seconds = std::getenv("CURLEW_MONKEY_SECONDS");
  const auto end = Clock::now() + std::chrono::duration<double>(seconds != nullptr ? std::atof(seconds) : 2);
  const TemporaryFolder folder;
  Desk desk(folder.path(), 960, 540);
  desk.open("dam_break_2d");
  std::mt19937 random(5);
  const auto roll = [&](int sides) { return static_cast<int>(random() % static_cast<unsigned>(sides)); };
  const auto place = [&] { return std::pair(static_cast<float>(roll(960)), static_cast<float>(roll(540))); };
  constexpr const char* known[] = {"play", "step",  "reset",      "viscosity.nu", "colour by",  "cut", "dark",
                                   "Undo", "scene", "hold plots", "Save",         "Checkpoint", "map", "Help"};
  constexpr char keys[] = {' ', 'S', 'R', 'F', 'H', '1', '5', 'Z', 'Y'};
  bool recording = false;
  int actions = 0;
  for (; Clock::now() < end; ++actions) {
    switch (roll(8)) {
      case 0:
        desk.key(keys[roll(sizeof keys)], roll(3) == 0);
        break;
      case 1:
        desk.wheel(static_cast<float>(roll(7) - 3));
        break;
      case 2:
        desk.drag_in_picture(static_cast<float>(roll(200) - 100), static_cast<float>(roll(200) - 100), roll(3));
        break;
      case 3: {
        const char* widget = known[roll(std::size(known))];
        try {
          desk.click(widget);
        } catch (const std::out_of_range&) {  // not shown at the moment
        }
        break;
      }
      case 4:
        recording = !recording;
        desk.session.record(recording ? 60 : 0);
        break;
      default: {
        const auto [x, y] = place();
        desk.press_at(x, y);
        const auto [to_x, to_y] = place();
        if (roll(3) == 0) desk.move_to(to_x, to_y);
        desk.release();
      }
    }
    if (desk.requests.restyle) desk.restyle(desk.interface().dark(), desk.interface().scale());
  }
  INFO(actions << " actions");
  CHECK(actions > 5);
  desk.session.play(false);
  desk.session.record(0);
  desk.settle();
  CHECK(desk.interface().status().state != RunState::empty);
  const auto step = desk.interface().status().step;
  if (desk.interface().status().state == RunState::paused) {
    desk.session.step_once();
    desk.settle();
    CHECK((desk.interface().status().step == step + 1 || desk.interface().status().state == RunState::diverged));
  }
}
