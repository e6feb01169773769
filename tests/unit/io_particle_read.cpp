// Particle files come back as they were written, and what is no such file is told.
#include <catch2/catch.hpp>

#include "sim/core/error.h"
#include "sim/core/fields.h"
#include "sim/io/particle_files.h"
#include "sim/io/particle_read.h"
#include "tests/io/sample_fields.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

using Writer = void (*)(const std::string&, const ParticleExport&);
constexpr std::pair<const char*, Writer> formats[] = {{"vtk", write_vtk}, {"ply", write_ply}, {"bgeo", write_bgeo}};

std::string written(const TemporaryFolder& folder, const char* kind, Writer write, std::size_t particles) {
  const Fields fields = sample_fields(particles);
  std::vector<float> density;
  std::vector<Vec3> swirl;
  for (std::size_t i = 0; i < particles; ++i) {
    density.push_back(990 + static_cast<float>(i));
    swirl.push_back({1, 2, static_cast<float>(i)});
  }
  const std::string file = folder / ("particles." + std::string(kind));
  write(file, {.time = 0.1,
               .step = 12,
               .id = fields.id,
               .position = fields.position,
               .velocity = fields.velocity,
               .density = density,
               .extra = {{"swirl", std::span<const Vec3>(swirl)}}});
  return file;
}

}  // namespace

TEST_CASE("each format comes back as it was written") {
  const TemporaryFolder folder;
  for (const auto& [kind, write] : formats) {
    for (const std::size_t particles : {std::size_t{0}, std::size_t{1}, std::size_t{2500}}) {
      CAPTURE(kind, particles);
      const Fields fields = sample_fields(particles);
      const ParticleSet set = read_particles(written(folder, kind, write, particles));
      REQUIRE(set.id.size() == particles);
      for (std::size_t i = 0; i < particles; ++i) {
        CHECK(set.id[i] == fields.id[i]);
        CHECK(set.density[i] == 990 + static_cast<float>(i));
        for (int axis = 0; axis < 3; ++axis) {
          CHECK(set.position[i][axis] == fields.position[i][axis]);
          CHECK(set.velocity[i][axis] == fields.velocity[i][axis]);
        }
      }
      if (std::string(kind) != "bgeo") {
        CHECK(set.time == 0.1);
        CHECK(set.step == 12);
      }
    }
  }
}

TEST_CASE("a particle file cut anywhere is refused, with its name") {
  const TemporaryFolder folder;
  for (const auto& [kind, write] : formats) {
    const std::string file = written(folder, kind, write, 5), text = file_text(file);
    for (std::size_t size = 1; size + 150 < text.size(); size += 7) {
      put_file(file, text.substr(0, size));
      CAPTURE(kind, size);
      CHECK_THROWS_WITH(read_particles(file), Catch::Contains(file));
    }
  }
}

TEST_CASE("what is no particle file of ours is refused") {
  const TemporaryFolder folder;
  put_file(folder / "a.ply", "ply\nformat ascii 1.0\n");
  CHECK_THROWS_WITH(read_particles(folder / "a.ply"),
                    Catch::EndsWith("found \"format ascii 1.0\", expected \"format binary_little_endian 1.0\" as this "
                                    "program writes it"));
  put_file(folder / "b.xyz", "1 2 3\n");
  CHECK_THROWS_WITH(read_particles(folder / "b.xyz"),
                    Catch::EndsWith("found a file of another kind, expected .vtk, .ply or .bgeo"));
  put_file(folder / "c.ply",
           "ply\nformat binary_little_endian 1.0\ncomment Curlew\nelement vertex 999999999999\nend_header\n");
  CHECK_THROWS_WITH(read_particles(folder / "c.ply"),
                    Catch::Contains("expected a number of particles that it can hold"));
  put_file(folder / "d.ply",
           "ply\nformat binary_little_endian 1.0\ncomment Curlew\nelement vertex 1\nproperty float vx\nproperty float "
           "density\nproperty uint id\nproperty float x\nend_header\n0123456789abcdef");
  CHECK_THROWS_WITH(read_particles(folder / "d.ply"), Catch::EndsWith("cut short in its particles"));
}
