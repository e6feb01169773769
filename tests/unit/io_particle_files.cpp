// VTK, PLY and bgeo: the bytes, read by readers that share no code with the writers.
#include <sys/wait.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>

#include "sim/core/fields.h"
#include "sim/io/particle_files.h"
#include "tests/io/file_size_limit.h"
#include "tests/io/sample_fields.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

struct Sample {
  explicit Sample(std::size_t particles) : fields(sample_fields(particles)), density(particles), vorticity(particles) {
    for (std::size_t i = 0; i < particles; ++i) {
      density[i] = 1000 + static_cast<float>(i);
      vorticity[i] = {1, static_cast<float>(i), -2, 77};
    }
  }
  ParticleExport view() const {
    return {.time = 0.1,
            .step = 12,
            .id = fields.id,
            .position = fields.position,
            .velocity = fields.velocity,
            .density = density,
            .extra = {{"speed", std::span<const float>(density)}, {"vorticity", std::span<const Vec3>(vorticity)}}};
  }
  Fields fields;
  Array<float> density;
  Array<Vec3> vorticity;
};

// Takes a file apart from front to back.
struct Bytes {
  std::string text;
  std::size_t at = 0;

  std::string take(std::size_t count) {
    REQUIRE(at + count <= text.size());
    at += count;
    return text.substr(at - count, count);
  }
  template <class T>
  T big() {
    const std::string raw = take(sizeof(T));
    std::uint64_t bits = 0;
    for (const char c : raw) bits = bits << 8 | static_cast<unsigned char>(c);
    if constexpr (sizeof(T) == 2) return std::bit_cast<T>(static_cast<std::uint16_t>(bits));
    if constexpr (sizeof(T) == 4) return std::bit_cast<T>(static_cast<std::uint32_t>(bits));
    if constexpr (sizeof(T) == 8) return std::bit_cast<T>(bits);
  }
  template <class T>
  T little() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  Vec3 big_vector() {
    const float x = big<float>(), y = big<float>();
    return {x, y, big<float>()};
  }
};

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

TEST_CASE("PLY holds the particles bit for bit", "[io][particles]") {
  const TemporaryFolder folder;
  const Sample sample(2500);  // more than the writer's block
  write_ply(folder / "particles/000000.ply", sample.view());
  CHECK(folder.contents() == std::vector<std::string>{"particles", "particles/000000.ply"});

  Bytes file{file_text(folder / "particles/000000.ply")};
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment Curlew, time 0.1 s, step 12\nelement vertex 2500\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property float vx\nproperty float vy\nproperty float vz\nproperty float density\nproperty uint id\n"
      "property float speed\nproperty float vorticity_x\nproperty float vorticity_y\nproperty float vorticity_z\n"
      "end_header\n";
  REQUIRE(file.take(header.size()) == header);
  REQUIRE(file.text.size() == header.size() + 2500 * 12 * 4);
  for (std::size_t i = 0; i < 2500; ++i) {
    for (int axis = 0; axis < 3; ++axis) REQUIRE(file.little<float>() == sample.fields.position[i][axis]);
    for (int axis = 0; axis < 3; ++axis) REQUIRE(file.little<float>() == sample.fields.velocity[i][axis]);
    REQUIRE(file.little<float>() == sample.density[i]);
    REQUIRE(file.little<std::uint32_t>() == sample.fields.id[i]);
    REQUIRE(file.little<float>() == sample.density[i]);
    for (int axis = 0; axis < 3; ++axis) REQUIRE(file.little<float>() == sample.vorticity[i][axis]);
  }
}

TEST_CASE("bgeo holds the particles bit for bit", "[io][particles]") {
  const TemporaryFolder folder;
  const Sample sample(1025);
  write_bgeo(folder / "a.bgeo", sample.view());

  Bytes file{file_text(folder / "a.bgeo")};
  CHECK(file.take(5) == "BgeoV");
  for (const int expected : {5, 1025, 0, 0, 0, 5, 0, 0, 0}) CHECK(file.big<std::int32_t>() == expected);
  struct Attribute {
    std::string name;
    int size, type;
  };
  const Attribute attributes[] = {{"v", 3, 5}, {"density", 1, 0}, {"id", 1, 1}, {"speed", 1, 0}, {"vorticity", 3, 5}};
  for (const Attribute& attribute : attributes) {
    CHECK(file.take(static_cast<std::size_t>(file.big<std::int16_t>())) == attribute.name);
    CHECK(file.big<std::int16_t>() == attribute.size);
    CHECK(file.big<std::int32_t>() == attribute.type);
    for (int i = 0; i < attribute.size; ++i) CHECK(file.big<std::int32_t>() == 0);
  }
  for (std::size_t i = 0; i < 1025; ++i) {
    REQUIRE(same(file.big_vector(), sample.fields.position[i]));
    REQUIRE(file.big<float>() == 1);
    REQUIRE(same(file.big_vector(), sample.fields.velocity[i]));
    REQUIRE(file.big<float>() == sample.density[i]);
    REQUIRE(file.big<std::uint32_t>() == sample.fields.id[i]);
    REQUIRE(file.big<float>() == sample.density[i]);
    REQUIRE(same(file.big_vector(), sample.vorticity[i]));
  }
  CHECK(file.take(2) == std::string("\x00\xff", 2));
  CHECK(file.at == file.text.size());
}

TEST_CASE("VTK holds the particles bit for bit", "[io][particles]") {
  const TemporaryFolder folder;
  const Sample sample(1100);
  write_vtk(folder / "a.vtk", sample.view());

  Bytes file{file_text(folder / "a.vtk")};
  const auto expect = [&](const std::string& text) { REQUIRE(file.take(text.size()) == text); };
  expect("# vtk DataFile Version 3.0\nCurlew, time 0.1 s, step 12\nBINARY\nDATASET POLYDATA\nFIELD FieldData 2\n");
  expect("TIME 1 1 double\n");
  CHECK(file.big<double>() == 0.1);
  expect("\nCYCLE 1 1 double\n");
  CHECK(file.big<double>() == 12);
  expect("\nPOINTS 1100 float\n");
  for (const Vec3& position : sample.fields.position) REQUIRE(same(file.big_vector(), position));
  expect("\nVERTICES 1100 2200\n");
  for (int i = 0; i < 1100; ++i) {
    REQUIRE(file.big<std::int32_t>() == 1);
    REQUIRE(file.big<std::int32_t>() == i);
  }
  expect("\nPOINT_DATA 1100\nVECTORS velocity float\n");
  for (const Vec3& velocity : sample.fields.velocity) REQUIRE(same(file.big_vector(), velocity));
  expect("\nSCALARS density float 1\nLOOKUP_TABLE default\n");
  for (const float density : sample.density) REQUIRE(file.big<float>() == density);
  expect("\nSCALARS id unsigned_int 1\nLOOKUP_TABLE default\n");
  for (const std::uint32_t id : sample.fields.id) REQUIRE(file.big<std::uint32_t>() == id);
  expect("\nSCALARS speed float 1\nLOOKUP_TABLE default\n");
  for (const float density : sample.density) REQUIRE(file.big<float>() == density);
  expect("\nVECTORS vorticity float\n");
  for (const Vec3& vorticity : sample.vorticity) REQUIRE(same(file.big_vector(), vorticity));
  expect("\n");
  CHECK(file.at == file.text.size());
}

TEST_CASE("VTK's own reader reads the particles", "[io][particles]") {
  const TemporaryFolder folder;
  for (const std::size_t particles : {0u, 1u, 1100u}) {
    const Sample sample(particles);
    write_vtk(folder / "a.vtk", sample.view());
    write_ply(folder / "a.ply", sample.view());
    const std::string command = "python3 '" CURLEW_SOURCE_DIR "/tests/io/check_vtk.py' '" + (folder / "a.vtk") + "' '" +
                                (folder / "a.ply") + "' 0.1 > '" + (folder / "log") + "' 2>&1";
    const int status = std::system(command.c_str());
    const std::string log = file_text(folder / "log");
    REQUIRE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127) {
      WARN("skipped: " << log);
      return;
    }
    INFO(log);
    CHECK(WEXITSTATUS(status) == 0);
  }
}

TEST_CASE("particle files of an empty scene are complete", "[io][particles]") {
  const TemporaryFolder folder;
  const Sample sample(0);
  write_vtk(folder / "a.vtk", sample.view());
  write_ply(folder / "a.ply", sample.view());
  write_bgeo(folder / "a.bgeo", sample.view());
  CHECK(folder.contents() == std::vector<std::string>{"a.bgeo", "a.ply", "a.vtk"});
  CHECK(file_text(folder / "a.bgeo").ends_with(std::string("\x00\xff", 2)));
}

TEST_CASE("particle files that cannot be written leave nothing", "[io][particles]") {
  const TemporaryFolder folder;
  const Sample sample(20000);
  const std::string path = folder / "a.file";
  for (const auto write : {write_vtk, write_ply, write_bgeo}) {
    CHECK(input_error([&] {
            const FileSizeLimit limit(1 << 19);
            write(path, sample.view());
          }) == "cannot write " + path + ": File too large; choose another folder");
    CHECK(folder.contents().empty());
    ParticleExport uneven = sample.view();
    uneven.density = uneven.density.first(10);
    CHECK_THROWS_WITH(write(path, uneven), "particle export: density has another length than id");
    CHECK(folder.contents().empty());
  }
}
