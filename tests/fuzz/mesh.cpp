// libFuzzer's entry to the readers of meshes: the same bytes as an OBJ, a PLY and an STL file that a scene names as its
// body. Each gives a mesh or one sentence; a mesh that was read has finite vertices and triangles of them, and where it
// is small, a scene that takes it can be laid out.
#include <algorithm>
#include <cmath>
#include <string>

#include "sim/scene/mesh.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"
#include "sim/scene/sampling.h"
#include "tests/fuzz/fuzz.h"
#include "tests/io/box_mesh.h"

using namespace curlew;

namespace {

const char* const kinds[] = {"obj", "ply", "stl"};

std::string scene_with(const std::string& kind) {
  return R"({"curlew": 1, "particle_radius": 0.25, "domain": {"min": [-2, -2, -2], "max": [2, 2, 2]},
    "fluid": [{"box": {"min": [-2, -2, -2], "max": [2, -1, 2]}}], "bodies": [{"mesh": {"file": "body.)" +
         kind + "\"}}]}";
}

void check_mesh(const TriangleMesh& mesh) {
  test::require(!mesh.triangles.empty());
  for (const Vec3d& v : mesh.vertices) test::require(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
  for (const auto& triangle : mesh.triangles) {
    test::require(*std::max_element(triangle.begin(), triangle.end()) < mesh.vertices.size());
  }
}

}  // namespace

// An empty corpus begins with a box in every format: no chance would find a closed mesh.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::filesystem::path folder = test::corpus_folder(*argc, *argv);
  if (folder.empty() || !std::filesystem::is_empty(folder)) return 0;
  const TriangleMesh box = test::box();
  test::put_file(folder / "box.obj", test::obj_text(box));
  for (const bool binary : {false, true}) {
    const std::string name = binary ? "binary." : "ascii.";
    test::put_file(folder / (name + "ply"), test::ply_text(box, binary));
    test::put_file(folder / (name + "stl"), test::stl_text(box, binary));
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  for (const std::string kind : kinds) {
    const std::string file = folder / "body." + kind;
    test::put_file(file, {reinterpret_cast<const char*>(data), size});
    try {
      const TriangleMesh mesh = load_mesh(file);
      check_mesh(mesh);
      if (mesh.triangles.size() > 100) continue;  // the rock takes five seconds with all these eyes
      const Scene scene = parse_scene(scene_with(kind), folder / "scene.json");
      check_resolution(scene, 16e9);
      sample_fluid(scene);
      for (const Body& body : scene.bodies) sample_body(body.shape, scene.spacing(), scene.dimension, scene.domain);
    } catch (const InputError& error) {
      test::check_sentence(error.what());
    }
  }
  return 0;
}
