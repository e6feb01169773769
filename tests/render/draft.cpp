// Drafts: quick pictures that must not show anything else than the full ones do.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "render/context.h"
#include "render/in_sight.h"
#include "render/renderer.h"
#include "tests/render/pictures.h"

using namespace curlew;
using namespace curlew::test;

namespace {

// Water as a solver has it, without the rows of a lattice through which one could look.
Frame shaken_water(double step) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> shift(-0.3f * static_cast<float>(step), 0.3f * static_cast<float>(step));
  std::vector<Vec3> positions;
  for (double x = -1 + step / 2; x < 1; x += step)
    for (double y = -1 + step / 2; y < -0.4 * x; y += step)
      for (double z = -1 + step / 2; z < 1; z += step)
        positions.push_back(to_float({x, y, z}) + Vec3{shift(random), shift(random), shift(random)});
  for (Vec3& p : positions) p.w = 1;
  Frame frame = frame_of(std::move(positions), 0.5 * step);
  for (const Vec3& p : frame.position) frame.value.push_back(p.y);
  frame.colour = {"height", "height", "m"};
  return frame;
}

Frame only(const Frame& frame, const std::vector<std::uint32_t>& kept) {
  Frame part = frame;
  part.position.clear();
  part.value.clear();
  for (const auto i : kept) {
    part.position.push_back(frame.position[i]);
    part.value.push_back(frame.value[i]);
  }
  return part;
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
  return sum / static_cast<double>(a.rgba.size());
}

View from_the_front() {
  Camera camera;
  camera.position = Vec3d{0, 0, 3};
  camera.target = Vec3d{0, 0, 0};
  Domain domain;
  domain.min = {-1, -1, -1};
  domain.max = {1, 1, 1};
  return view_of(camera, domain, 3, 1.5);
}

}  // namespace

TEST_CASE("what is deep in the water can be left out of a picture and nobody sees it") {
  const OffscreenContext context;
  const Frame frame = shaken_water(0.06);
  ViewSettings settings = bare_view();
  settings.particle_scale = 1.15;
  settings.look.range = {-1.0, 1.0};
  for (const Vec3d eye : {Vec3d{2.5, 1.5, 3}, Vec3d{-3, 0.1, 0.2}, Vec3d{0.01, 4, 0}, Vec3d{0.6, 0.2, 1.4}}) {
    settings.camera.position = eye;
    settings.camera.target = Vec3d{0, -0.5, 0};
    const View view = view_of(settings.camera, frame.geometry->domain, 3, 1.5);
    const auto kept = in_sight(frame.position, view, 0.06);
    CHECK(kept.size() < 50 * frame.position.size() / 100);
    CHECK(std::is_sorted(kept.begin(), kept.end()));
    Renderer renderer(480, 320, 1);
    const Image all = renderer.draw(frame, settings), part = renderer.draw(only(frame, kept), settings);
    CHECK(differing_pixels(all, part, 24) < 0.003 * 480 * 320);
  }
}

TEST_CASE("lone drops are in sight, what is behind the eye or beside the picture is not") {
  const View view = from_the_front();
  const float nan = std::nanf(""), huge = std::numeric_limits<float>::max();
  const std::vector<Vec3> drops{{0, 0, 0},   {0.1f, 0.2f, -0.9f}, {0, 0, -1},     {0, 0, 3.5f},      {50, 0, 0},
                                {0, nan, 0}, {nan, nan, nan},     {0, 0, -1e30f}, {huge, huge, huge}};
  CHECK(in_sight(drops, view, 0.05) == std::vector<std::uint32_t>{0, 1, 2, 7});
  CHECK(in_sight({}, view, 0.05).empty());
}

TEST_CASE("a curtain of small drops hides nothing") {
  const View view = from_the_front();
  std::vector<Vec3> drops{{0, 0, -0.9f}};
  for (float z = 0.5f; z < 0.8f; z += 0.1f)
    for (float x = -0.5f; x < 0.5f; x += 0.02f)
      for (float y = -0.5f; y < 0.5f; y += 0.02f) drops.push_back({x, y, z});
  for (const float size : {1.f, 0.6f}) {
    for (Vec3& p : drops) p.w = size;
    CHECK((in_sight(drops, view, 0.05).front() == 0) == (size < 1));
  }
}

TEST_CASE("a draft shows what the full picture shows, and leaves no trace in the next") {
  const OffscreenContext context;
  const Frame frame = GENERATE(shaken_water(0.08), slope_of_water(2));
  ViewSettings settings;
  Renderer renderer(640, 400, 1), fresh(640, 400, 1);
  const auto drafted = [&] {
    renderer.render(frame, settings, Renderer::Detail::draft);
    return renderer.read();
  };
  const Image full = fresh.draw(frame, settings), draft = drafted();
  CHECK(draft.width == 640);
  CHECK(draft.height == 400);
  CHECK(mean_difference(full, draft) < 4);
  CHECK(drafted().rgba == draft.rgba);
  CHECK(renderer.draw(frame, settings).rgba == full.rgba);

  // Legend and time, at the rim, are as sharp as ever.
  int differing = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 90; ++x) differing += difference(full.at(x, y), draft.at(x, y)) > 24;
  CHECK(differing < 20);

  // A point under the mouse is the same to a few particles.
  renderer.render(frame, settings, Renderer::Detail::draft);
  const auto rough = renderer.point_at(300, 220);
  renderer.render(frame, settings);
  const auto fine = renderer.point_at(300, 220);
  REQUIRE((rough && fine));
  CHECK(length(*rough - *fine) < 0.2);

  // Small drops let one look inside: nothing may be missing there.
  settings.particle_scale = 0.4;
  CHECK(mean_difference(fresh.draw(frame, settings), drafted()) < 6);

  renderer.resize(320, 200);
  fresh.resize(320, 200);
  CHECK(mean_difference(drafted(), fresh.draw(frame, settings)) < 8);
}
