// libFuzzer's entry to the reader of heights: a CSV file that a scene names as its ground, in 2D and in 3D.
#include <string>

#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"
#include "tests/fuzz/fuzz.h"

using namespace curlew;

namespace {

const char* const scenes[] = {
    R"({"curlew": 1, "dimension": 2, "particle_radius": 0.05, "domain": {"min": [0, 0], "max": [2, 2]},
      "fluid": [{"box": {"min": [0, 1], "max": [2, 2]}}],
      "bodies": [{"heightfield": {"file": "heights.csv", "min": [0, 0], "max": [2, 1]}}]})",
    R"({"curlew": 1, "particle_radius": 0.1, "domain": {"min": [0, 0, 0], "max": [2, 2, 2]},
      "fluid": [{"box": {"min": [0, 1, 0], "max": [2, 2, 2]}}],
      "bodies": [{"heightfield": {"file": "heights.csv", "min": [0, 0, 0], "max": [2, 1, 2]}}]})"};

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::filesystem::path folder = test::corpus_folder(*argc, *argv);
  if (folder.empty() || !std::filesystem::is_empty(folder)) return 0;
  test::put_file(folder / "outline.csv", "0.1,0.5,0.3\n");
  test::put_file(folder / "ground.csv", "# rows along z\r\n0.1, 0.5, 3e-1\r\n\r\n0.2, -1, 7\r\n");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  test::put_file(folder / "heights.csv", {reinterpret_cast<const char*>(data), size});
  for (const char* text : scenes) {
    try {
      const Scene scene = parse_scene(text, folder / "scene.json");
      check_resolution(scene, 16e9);
      sample_fluid(scene);
      for (const Body& body : scene.bodies) sample_body(body.shape, scene.spacing(), scene.dimension, scene.domain);
    } catch (const InputError& error) {
      test::check_sentence(error.what());
    }
  }
  return 0;
}
