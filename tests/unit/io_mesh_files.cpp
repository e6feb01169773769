// The surface as PLY and OBJ, read back by the readers of body meshes, which share no code with the writers.
#include <catch2/catch.hpp>
#include <cstring>

#include "sim/core/error.h"
#include "sim/io/mesh_files.h"
#include "sim/scene/mesh_formats.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

SurfaceMesh pyramid(bool moving) {
  SurfaceMesh mesh;
  mesh.position = {{0, 0, 0}, {1.5f, 0, 0}, {0, 1, 0}, {0.1f, 0.2f, 1e-7f}};
  mesh.normal = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (moving) mesh.velocity = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

void check_same(const TriangleMesh& read, const SurfaceMesh& mesh) {
  REQUIRE(read.vertices.size() == mesh.position.size());
  for (std::size_t v = 0; v < read.vertices.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) CHECK(static_cast<float>(read.vertices[v][axis]) == mesh.position[v][axis]);
  }
  CHECK(read.triangles == mesh.triangles);
}

}  // namespace

TEST_CASE("a PLY mesh holds positions, normals, velocities and triangles") {
  const TemporaryFolder folder;
  for (const bool moving : {false, true}) {
    const SurfaceMesh mesh = pyramid(moving);
    const std::string file = folder / "mesh.ply";
    write_mesh_ply(file, mesh, 0.25, 12);
    const std::string text = file_text(file);
    check_same(read_ply(text, file), mesh);
    CHECK(text.find("comment Curlew, time 0.25 s, step 12\n") != std::string::npos);
    const auto body = text.find("end_header\n") + 11;
    const std::size_t stride = moving ? 36 : 24;
    CHECK(text.size() == body + 4 * stride + 4 * 13);
    float last[9];
    std::memcpy(last, &text[body + 3 * stride], stride);
    CHECK(last[5] == 1);
    if (moving) CHECK(last[8] == 12);
  }
}

TEST_CASE("an OBJ mesh holds positions, normals and triangles") {
  const TemporaryFolder folder;
  const SurfaceMesh mesh = pyramid(false);
  const std::string file = folder / "mesh.obj";
  write_mesh_obj(file, mesh, 0.25, 12);
  const std::string text = file_text(file);
  check_same(read_obj(text, file), mesh);
  CHECK(text.find("# Curlew, time 0.25 s, step 12\n") == 0);
  CHECK(text.find("vn 0 0 1\n") != std::string::npos);
  CHECK(text.find("f 1//1 3//3 2//2\n") != std::string::npos);
}

TEST_CASE("an empty surface is a file too") {
  const TemporaryFolder folder;
  write_mesh_ply(folder / "mesh.ply", {}, 0, 0);
  write_mesh_obj(folder / "mesh.obj", {}, 0, 0);
  CHECK(file_text(folder / "mesh.ply").find("element face 0\n") != std::string::npos);
  CHECK(file_text(folder / "mesh.obj") == "# Curlew, time 0 s, step 0\no water\n");
}
