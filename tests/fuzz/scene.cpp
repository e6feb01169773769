// libFuzzer's entry to the reader of scenes: a text gives a scene or one sentence. A scene that was read can be
// written, and what was written reads back to the same; its size can be told, and where it is small, its particles laid
// out.
#include <cstdint>
#include <cstring>
#include <string>

#include "sim/core/error.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"
#include "tests/fuzz/fuzz.h"

using namespace curlew;

namespace {

// The first writing may still turn -0 into 0; from then on nothing changes.
void check_written(const std::string& first) {
  try {
    const std::string second = scene_json(parse_scene(first, "fuzz.json"));
    test::require(second.size() <= first.size() && scene_json(parse_scene(second, "fuzz.json")) == second);
  } catch (const InputError&) {
    test::require(false);
  }
}

// Whether laying out takes little: the particles are few, and so are the places that are looked at for them.
bool is_small(const Scene& scene) {
  double places = 1;
  for (int axis = 0; axis < scene.dimension; ++axis) {
    places *= (scene.domain.max[axis] - scene.domain.min[axis]) / scene.spacing();
  }
  return places < 1e4;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const Scene scene = parse_scene(text, "fuzz.json");
    check_written(scene_json(scene));
    check_resolution(scene, 16e9);
    if (is_small(scene)) sample_fluid(scene);
  } catch (const InputError& error) {
    test::check_sentence(error.what());
  }
  return 0;
}
