// Checkpoints: what was written is read back bit for bit.
#include "sim/io/checkpoint.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "sim/measure/state_hash.h"
#include "tests/io/checkpoint_bytes.h"
#include "tests/io/file_size_limit.h"

using namespace curlew;
using namespace curlew::test;

namespace {

void check_same(const Fields& found, const Fields& expected) {
  for_each_field(found, [&]<class T>(const FieldRow& row, const Array<T>& array) {
    INFO(row.name);
    for_each_field(expected, [&]<class U>(const FieldRow& other_row, const Array<U>& other) {
      if (row.id != other_row.id) return;
      const std::size_t values = row.kind == FieldKind::kept ? other.size() : 0;
      REQUIRE(array.size() == values);
      if (values > 0) CHECK(std::memcmp(array.data(), other.data(), values * sizeof(T)) == 0);
    });
  });
}

}  // namespace

TEST_CASE("a checkpoint gives back the state bit for bit, in its order", "[io][checkpoint]") {
  const TemporaryFolder folder;
  for (const std::size_t particles : {0u, 1u, 7u, 50000u}) {
    Fields fields = sample_fields(particles);
    if (particles > 0) {
      fields.position[0].w = -7;
      fields.velocity[0] = {-0.0f, 1e-45f, 3e38f, 0};
    }
    fields.density.assign(particles, 1);  // scratch stays behind
    write_checkpoint(folder / "checkpoints/000000.curlew", sample_info(), fields);
    const Checkpoint read = read_checkpoint(folder / "checkpoints/000000.curlew");
    check_same(read.fields, fields);
    CHECK(state_hash(read.fields) == state_hash(fields));
  }
  CHECK(folder.contents() == std::vector<std::string>{"checkpoints", "checkpoints/000000.curlew"});
}

TEST_CASE("a checkpoint gives back what else the run carries", "[io][checkpoint]") {
  const CheckpointInfo info = sample_info();
  const Checkpoint read = CheckpointBytes(info, sample_fields(3)).read();
  CHECK(read.scene_json == info.scene_json);
  CHECK(read.scene_file == info.scene_file);
  CHECK(read.program_version == info.program_version);
  CHECK(read.isa == info.isa);
  CHECK(read.seed == info.seed);
  CHECK(read.step == info.step);
  CHECK(read.time == info.time);
  CHECK(read.dt == info.dt);
  CHECK(read.numbers == info.numbers);

  CheckpointInfo large = info;
  large.scene_json = std::string(3 << 20, '{');
  large.numbers.clear();
  CHECK(CheckpointBytes(large, sample_fields(3)).read().scene_json == large.scene_json);
}

TEST_CASE("fields that are not in use stay so", "[io][checkpoint]") {
  Fields fields = sample_fields(10);
  fields.density_stiffness.clear();
  check_same(CheckpointBytes(sample_info(), fields).read().fields, fields);
  fields.velocity.pop_back();
  CHECK_THROWS_WITH(CheckpointBytes(sample_info(), fields), "checkpoint: velocity has another length than id");
}

TEST_CASE("the same state gives the same checkpoint", "[io][checkpoint]") {
  const Fields fields = sample_fields(1000);
  CHECK(CheckpointBytes(sample_info(), fields).bytes == CheckpointBytes(sample_info(), fields).bytes);
}

TEST_CASE("particles at rest make a small checkpoint that can still be read", "[io][checkpoint]") {
  Fields fields = sample_fields(200000);
  fields.position.assign(200000, {});
  fields.velocity.assign(200000, {});
  fields.density_stiffness.clear();
  fields.divergence_stiffness.clear();
  for (std::size_t i = 0; i < fields.id.size(); ++i) fields.id[i] = static_cast<std::uint32_t>(i);
  check_same(CheckpointBytes(sample_info(), fields).read().fields, fields);
}

TEST_CASE("a checkpoint that cannot be written leaves the old one", "[io][checkpoint]") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.curlew";
  write_checkpoint(path, sample_info(), sample_fields(10));
  const std::string before = file_text(path);
  CHECK(input_error([&] {
          const FileSizeLimit limit(100000);
          write_checkpoint(path, sample_info(), sample_fields(20000));
        }) == "cannot write " + path + ": File too large; choose another folder");
  CHECK(file_text(path) == before);
  CHECK(folder.contents() == std::vector<std::string>{"a.curlew"});
}
