// Meshes from OBJ, PLY and STL files: the same box from each, and what must be refused.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>

#include "sim/core/error.h"
#include "sim/scene/mesh.h"
#include "sim/scene/mesh_index.h"
#include "tests/io/box_mesh.h"

using namespace curlew;
using namespace curlew::test;

namespace {

// A folder of its own, gone afterwards.
struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / ("curlew_mesh_" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

void check_box(const std::filesystem::path& file) {
  INFO(file.filename());
  const TriangleMesh mesh = load_mesh(file);
  CHECK(mesh.vertices.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  CHECK(signed_volume(mesh) == Approx(6));
  CHECK(surface_area(mesh) == Approx(22));
  CHECK_NOTHROW(require_closed(mesh, "box"));
}

}  // namespace

TEST_CASE("the same box comes from every format", "[mesh]") {
  const Folder folder;
  check_box(folder.write("box.obj", obj_text(box())));
  check_box(folder.write("ascii.ply", ply_text(box(), false)));
  check_box(folder.write("binary.ply", ply_text(box(), true)));
  check_box(folder.write("ascii.stl", stl_text(box(), false)));
  check_box(folder.write("binary.STL", stl_text(box(), true)));
  check_box(folder.write("quads.obj",
                         "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
                         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n"));
}

TEST_CASE("a mesh that is inside out is turned", "[mesh]") {
  const Folder folder;
  TriangleMesh mesh = box();
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  CHECK(signed_volume(mesh) == Approx(-6));
  check_box(folder.write("inside_out.obj", obj_text(mesh)));
}

TEST_CASE("vertices at one place join, and triangles that collapse go", "[mesh]") {
  const Folder folder;
  TriangleMesh mesh = box();
  mesh.vertices.push_back(mesh.vertices[0]);
  mesh.vertices.push_back({-0.0, 0, 0});
  mesh.triangles[0][0] = 8;  // the corner again, by other numbers
  mesh.triangles[1][0] = 9;
  mesh.triangles.push_back({0, 8, 1});  // no area
  check_box(folder.write("double.obj", obj_text(mesh)));
}

TEST_CASE("closedness counts what is wrong", "[mesh]") {
  TriangleMesh open = box();
  open.triangles.pop_back();
  CHECK_THROWS_WITH(require_closed(open, "a.obj"),
                    "a.obj: 3 of 18 edges are open, expected a closed surface, in which every "
                    "edge belongs to two triangles");
  TriangleMesh doubled = box();
  doubled.triangles.push_back(doubled.triangles[0]);
  CHECK_THROWS_WITH(require_closed(doubled, "a.obj"),
                    Catch::StartsWith("a.obj: 3 of 18 edges belong to more than two triangles"));
  TriangleMesh twisted = box();
  std::swap(twisted.triangles[0][0], twisted.triangles[0][1]);
  CHECK_THROWS_WITH(require_closed(twisted, "a.obj"), Catch::StartsWith("a.obj: 3 of 18 edges lie between triangles"));
}

TEST_CASE("meshes are scaled, turned about x, y, z in turn, and moved", "[mesh]") {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}};
  const auto check = [&](Vec3d degrees, Vec3d first, Vec3d second) {
    const TriangleMesh moved = transformed(mesh, 2, degrees, {10, 20, 30});
    CHECK(length(moved.vertices[0] - Vec3d{10, 20, 30} - first) < 1e-12);
    CHECK(length(moved.vertices[1] - Vec3d{10, 20, 30} - second) < 1e-12);
  };
  check({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  check({90, 0, 0}, {2, 0, 0}, {0, 0, 2});
  check({0, 90, 0}, {0, 0, -2}, {0, 2, 0});
  check({0, 0, 90}, {0, 2, 0}, {-2, 0, 0});
  check({90, 90, 0}, {0, 0, -2}, {2, 0, 0});
}

TEST_CASE("mutated meshes give a mesh or a sentence", "[mesh][malformed]") {
  const Folder folder;
  std::mt19937 random(1);
  const std::vector<std::pair<std::string, std::string>> files{{"a.obj", obj_text(box())},
                                                               {"a.ply", ply_text(box(), false)},
                                                               {"b.ply", ply_text(box(), true)},
                                                               {"a.stl", stl_text(box(), false)},
                                                               {"b.stl", stl_text(box(), true)}};
  for (const auto& [name, whole] : files) {
    int refused = 0;
    for (int round = 0; round < 120; ++round) {
      std::string text = whole;
      for (int change = 0; change <= round % 4; ++change)
        text[random() % text.size()] = static_cast<char>(random() % 256);
      if (round % 3 == 0) text.resize(1 + random() % text.size());
      try {
        load_mesh(folder.write(name, text));
      } catch (const InputError& error) {
        REQUIRE(std::string(error.what()).find(name) != std::string::npos);
        ++refused;
      }
    }
    INFO(name);
    CHECK(refused > 30);
  }
}

TEST_CASE("big-endian PLY with more properties than needed", "[mesh]") {
  const Folder folder;
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\ncomment by hand\nelement vertex 4\nproperty double x\n"
      "property double y\nproperty double z\nproperty uchar red\nelement face 4\n"
      "property list uchar ushort vertex_index\nproperty short flag\nelement edge 0\nend_header\n";
  const auto put_big = [&](auto value) {
    std::string raw;
    put(raw, value);
    bytes.append(raw.rbegin(), raw.rend());
  };
  for (const Vec3d& v : {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    for (int k = 0; k < 3; ++k) put_big(v[k]);
    put_big(std::uint8_t{7});
  }
  for (const auto& triangle : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{0, 3, 2}}) {
    put_big(std::uint8_t{3});
    for (const int index : triangle) put_big(static_cast<std::uint16_t>(index));
    put_big(std::int16_t{-1});
  }
  const TriangleMesh mesh = load_mesh(folder.write("big.ply", bytes));
  CHECK(signed_volume(mesh) == Approx(1.0 / 6));
  CHECK_NOTHROW(require_closed(mesh, "big"));
}

TEST_CASE("OBJ corners in all their spellings", "[mesh]") {
  const Folder folder;
  const auto file =
      folder.write("a.obj",
                   "# tetrahedron\r\no t\r\nv 0 0 0 # origin\r\nv +1 0 0 1.0\r\nv 0 1 0\r\nv 0 0 1e0\r\nvn 0 0 1\r\n"
                   "f 1 3 2\r\nf 1/1 2/1 4/1\r\nf -3//1 -2//1 -1//1\r\nf 1/1/1 4/1/1 3/1/1 # last\r\n");
  const TriangleMesh mesh = load_mesh(file);
  CHECK(mesh.triangles.size() == 4);
  CHECK(signed_volume(mesh) == Approx(1.0 / 6));
  CHECK_NOTHROW(require_closed(mesh, "a"));
}

TEST_CASE("distance to a triangle, thin and collapsed ones too", "[mesh]") {
  const Vec3d a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  CHECK(distance_to_triangle({1, 1, 3}, a, b, c) == Approx(3));
  CHECK(distance_to_triangle({-3, -4, 0}, a, b, c) == Approx(5));
  CHECK(distance_to_triangle({2, -3, 0}, a, b, c) == Approx(3));
  CHECK(distance_to_triangle({3, 3, 0}, a, b, c) == Approx(std::sqrt(2)));
  CHECK(distance_to_triangle({2, 5, 0}, a, b, b) == Approx(5));
  CHECK(distance_to_triangle({0, 5, 0}, a, a, a) == Approx(5));
}
