// Checkpoints that are not: each gives one sentence, none crashes, whatever the bytes.
#include <sys/stat.h>
#include <zstd.h>

#include <catch2/catch.hpp>
#include <limits>

#include "tests/io/checkpoint_bytes.h"

using namespace curlew;
using namespace curlew::test;

namespace {

const float not_a_number = std::numeric_limits<float>::quiet_NaN();
const std::string take_another = "; take another checkpoint";

CheckpointBytes sample() { return CheckpointBytes(sample_info(), sample_fields(10)); }

// Whatever the bytes: either a checkpoint or an InputError; anything else fails the test.
bool is_refused(const CheckpointBytes& checkpoint) {
  const std::string error = checkpoint.error();
  return error != "no error" && error.find('\n') == std::string::npos;
}

}  // namespace

TEST_CASE("checkpoint files that are none", "[io][checkpoint]") {
  const TemporaryFolder folder;
  const auto message = [](const std::string& path) { return input_error([&] { read_checkpoint(path); }); };
  const std::string path = folder / "000100.curlew";

  CHECK(message(path) == "cannot read " + path + ": No such file or directory");
  CHECK(message(folder.path()) ==
        folder.path() + " is a folder, not a checkpoint; give a file that --checkpoint-every wrote");
  put_file(folder / "000120.curlew", "");
  CHECK(message(path) ==
        "cannot read " + path + ": No such file or directory; did you mean " + (folder / "000120.curlew?"));
  CHECK(message(folder / "000120.curlew/a") == "cannot read " + (folder / "000120.curlew/a") + ": Not a directory");
  CHECK(message(folder / "000120.curlew") == (folder / "000120.curlew") + " is empty; take another checkpoint");
  put_file(folder / "run/checkpoints/000001.curlew", "");
  put_file(folder / "run/checkpoints/000002.curlew", "");
  CHECK(message(folder / "run") == (folder / "run") + " is a folder, not a checkpoint; did you mean " +
                                       (folder / "run/checkpoints/000002.curlew?"));
  put_file(path, "{\"curlew\": 1, \"name\": \"dam_break\"}");
  CHECK(message(path) == path + " is not a Curlew checkpoint: it does not begin with CURLEWCP");
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(message(folder / "pipe") ==
        (folder / "pipe") + " is not a regular file; give a file that --checkpoint-every wrote");
  CHECK(message("/dev/zero") == "/dev/zero is not a regular file; give a file that --checkpoint-every wrote");
}

TEST_CASE("checkpoints cut off", "[io][checkpoint]") {
  const CheckpointBytes whole = sample();
  const std::size_t size = whole.bytes.size();
  const auto cut = [&](std::size_t bytes) { return CheckpointBytes(whole.bytes.substr(0, bytes)).error(); };
  CHECK(cut(0) == "a.curlew is empty; take another checkpoint");
  CHECK(cut(5) == "a.curlew is cut off after 5 bytes; take another checkpoint");
  CHECK(cut(20) == "a.curlew is cut off after 20 bytes; take another checkpoint");
  for (std::size_t bytes = 24; bytes < size; ++bytes) {
    REQUIRE(cut(bytes) == "a.curlew is cut off after " + std::to_string(bytes) + " of " + std::to_string(size) +
                              " bytes; take another checkpoint");
  }
  CHECK(CheckpointBytes(whole.bytes + "xy").error() == "a.curlew is damaged: it has " + std::to_string(size + 2) +
                                                           " bytes where its header says " + std::to_string(size) +
                                                           take_another);
  CHECK(CheckpointBytes(whole).put(16, ~std::uint64_t{0}).error() ==
        "a.curlew is cut off after " + std::to_string(size) + " bytes; take another checkpoint");

  // On the disk, and large: every sixteenth of a file.
  const TemporaryFolder folder;
  const std::string large = CheckpointBytes(sample_info(), sample_fields(5000)).bytes;
  for (std::size_t part = 0; part < 16; ++part) {
    put_file(folder / "a", large.substr(0, large.size() * part / 16));
    CHECK(input_error([&] { read_checkpoint(folder / "a"); }) != "no error");
  }
}

TEST_CASE("every damaged byte of a checkpoint is found", "[io][checkpoint]") {
  const CheckpointBytes whole = sample();
  for (std::size_t at = 0; at < whole.bytes.size(); ++at) {
    for (const int mask : {0x01, 0x80, 0xff}) {
      CheckpointBytes damaged = whole;
      damaged.bytes[at] = static_cast<char>(damaged.bytes[at] ^ mask);
      INFO(at);
      REQUIRE(is_refused(damaged));
    }
  }
  CheckpointBytes damaged = whole;
  damaged.put(damaged.bytes.size() - 8, std::uint64_t{0x123});
  const std::string message = damaged.error();
  CHECK(message.starts_with("a.curlew is damaged: its checksum is 0000000000000123, its contents give "));
  CHECK(message.ends_with(take_another));
}

TEST_CASE("damage under a right checksum never crashes", "[io][checkpoint]") {
  const CheckpointBytes whole = sample();
  int refused = 0;
  for (std::size_t at = 8; at + 8 < whole.bytes.size(); ++at) {
    for (const int mask : {0x01, 0x10, 0x80, 0xff}) {
      CheckpointBytes damaged = whole;
      damaged.bytes[at] = static_cast<char>(damaged.bytes[at] ^ mask);
      refused += is_refused(damaged.seal());
    }
  }
  CHECK(refused > 500);  // the rest changed a letter of the scene or a bit of a number
}

TEST_CASE("checkpoints of other versions", "[io][checkpoint]") {
  CHECK(sample().put(8, std::uint32_t{2}).seal().error() ==
        "a.curlew has version 2 of the checkpoint format, this Curlew reads 1; use the Curlew that wrote it, or a "
        "newer one");
  CHECK(sample().put(8, std::uint32_t{0}).seal().error() ==
        "a.curlew is damaged: it says version 0 of the checkpoint format" + take_another);
}

TEST_CASE("checkpoints with other fields", "[io][checkpoint]") {
  CHECK(
      sample().rename("density_stiffness", "microrotation_abc").seal().error() ==
      "a.curlew holds the particle field \"microrotation_abc\", which this Curlew does not know; use the version that "
      "wrote it, \"0.1.0\"");
  // A field that is no kept one is as unknown.
  CHECK(
      sample().rename("density_stiffness", "boundary_friction").seal().error() ==
      "a.curlew holds the particle field \"boundary_friction\", which this Curlew does not know; use the version that "
      "wrote it, \"0.1.0\"");
  CHECK(
      sample().rename("velocity", "velo\n\xff\x1b[").seal().error() ==
      "a.curlew holds the particle field \"velo???[\", which this Curlew does not know; use the version that wrote it, "
      "\"0.1.0\"");
  CHECK(
      sample().put_field_count(4).seal().error() ==
      "a.curlew lacks the particle field \"divergence_stiffness\", which this Curlew needs; use the version that wrote "
      "it, \"0.1.0\"");
  CHECK(sample().put_field_count(0).seal().error() ==
        "a.curlew lacks the particle field \"position\", which this Curlew needs; use the version that wrote it, "
        "\"0.1.0\"");
  CHECK(sample().rename("Vec3", "Vec4").seal().error() ==
        "a.curlew holds the particle field \"position\" as \"Vec4\", this Curlew needs \"Vec3\"; use the version that "
        "wrote it, \"0.1.0\"");
  CHECK(sample().rename("velocity", "position").seal().error() ==
        "a.curlew is damaged: it holds the particle field \"position\" twice" + take_another);
}

TEST_CASE("checkpoints with impossible sizes", "[io][checkpoint]") {
  CHECK(sample().put_values("velocity", "Vec3", 9).seal().error() ==
        "a.curlew is damaged: the particle field \"velocity\" has 9 values for 10 particles" + take_another);
  CHECK(sample().put_values("velocity", "Vec3", 0).seal().error() ==
        "a.curlew is damaged: the particle field \"velocity\" has 0 values for 10 particles" + take_another);
  for (const std::uint64_t particles : {std::uint64_t{1} << 40, ~std::uint64_t{0}, std::uint64_t{1} << 60}) {
    CHECK(sample().put_particles(particles).seal().error() ==
          "a.curlew says that it holds " + std::to_string(particles) +
              " particles, which do not fit into the memory of this machine");
  }
  CHECK(sample().put_values("density_stiffness", "float", 0).seal().error() ==
        "a.curlew is damaged: its data do not hold the 400 bytes of its fields" + take_another);
  CHECK(sample().put(24, ~std::uint32_t{0}).seal().error() ==
        "a.curlew is damaged: its header ends too early" + take_another);
  CHECK(sample().put_field_count(~std::uint32_t{0}).seal().error() ==
        "a.curlew is damaged: its header ends too early" + take_another);

  CheckpointBytes longer = sample();
  const std::size_t payload = longer.payload();
  longer.bytes.insert(payload, "abc");
  longer.put(12, static_cast<std::uint32_t>(payload - 24 + 3)).seal();
  CHECK(longer.error() == "a.curlew is damaged: its header is longer than its contents" + take_another);
}

TEST_CASE("checkpoints whose data are not what they say", "[io][checkpoint]") {
  const auto with_payload = [](const std::string& frame) {
    CheckpointBytes changed = sample();
    changed.bytes = changed.bytes.substr(0, changed.payload()) + frame + std::string(8, '\0');
    return changed.put(16, std::uint64_t{frame.size()}).seal();
  };
  const CheckpointBytes whole = sample();
  const std::string frame = whole.bytes.substr(whole.payload(), whole.bytes.size() - 8 - whole.payload());
  CHECK(with_payload(frame).error() == "no error");
  CHECK(with_payload("").error() ==
        "a.curlew is damaged: its data do not hold the 440 bytes of its fields" + take_another);
  CHECK(with_payload(frame + "a").error() == "a.curlew is damaged: its data are longer than its fields" + take_another);
  CHECK(with_payload(frame.substr(0, frame.size() - 1)).error() ==
        "a.curlew is damaged: its data end too early" + take_another);
  std::string broken = frame;
  broken[7] = static_cast<char>(broken[7] | 6);  // a block of the type that zstd reserves
  CHECK(with_payload(broken).error().starts_with("a.curlew is damaged: its data cannot be decompressed ("));

  // A small file that claims gigabytes: found out before memory is taken.
  const std::size_t particles = 200000;
  Fields fields = sample_fields(particles);
  for_each_field(fields, [&]<class T>(const FieldRow& row, Array<T>& array) {
    if (row.kind == FieldKind::kept) array.assign(particles, T{});
  });
  CheckpointBytes bomb(sample_info(), fields);
  const auto declared = static_cast<std::uint32_t>(44 * particles), claimed = std::uint32_t{44 * 50000000u};
  const std::size_t at = bomb.bytes.find(std::string(reinterpret_cast<const char*>(&declared), 4), bomb.payload());
  REQUIRE(at < bomb.payload() + 16);
  bomb.put(at, claimed).put_particles(50000000);
  for (const char* name : {"position", "velocity"}) bomb.put_values(name, "Vec3", 50000000);
  for (const char* name : {"density_stiffness", "divergence_stiffness"}) bomb.put_values(name, "float", 50000000);
  const std::size_t id = bomb.bytes.find("std::uint32_t");
  bomb.put(id + 13, std::uint64_t{50000000}).seal();
  CHECK(bomb.error() == "a.curlew is damaged: " + std::to_string(bomb.bytes.size() - 8 - bomb.payload()) +
                            " bytes of data cannot hold the 2200000000 bytes of its fields" + take_another);
}

TEST_CASE("checkpoints with values that mean nothing", "[io][checkpoint]") {
  const auto with_fields = [](auto change) {
    Fields fields = sample_fields(10);
    change(fields);
    return CheckpointBytes(sample_info(), fields).error();
  };
  const auto with_info = [](auto change) {
    CheckpointInfo info = sample_info();
    change(info);
    return CheckpointBytes(info, sample_fields(10)).error();
  };
  const std::string diverged = "; take a checkpoint from before the simulation diverged";
  const std::string particle = std::to_string(sample_fields(10).id[3]);
  CHECK(with_fields([](Fields& f) { f.velocity[3].y = not_a_number; }) ==
        "a.curlew holds a velocity that is not finite (particle " + particle + ")" + diverged);
  CHECK(with_fields([](Fields& f) { f.position[3].z = 1 / 0.0f; }) ==
        "a.curlew holds a position that is not finite (particle " + particle + ")" + diverged);
  CHECK(with_fields([](Fields& f) { f.divergence_stiffness[3] = -not_a_number; }) ==
        "a.curlew holds a divergence_stiffness that is not finite (particle " + particle + ")" + diverged);
  CHECK(with_fields([](Fields& f) { f.position[3].w = not_a_number; }) == "no error");  // not part of the vector
  CHECK(with_fields([](Fields& f) { f.id[3] = f.id[7]; }) ==
        "a.curlew is damaged: particle " + std::to_string(sample_fields(10).id[7]) + " occurs twice" + take_another);

  CHECK(with_info([](CheckpointInfo& i) { i.time = not_a_number; }) ==
        "a.curlew is damaged: its time is nan" + take_another);
  CHECK(with_info([](CheckpointInfo& i) { i.dt = -1; }) ==
        "a.curlew is damaged: its time step is -1.000000" + take_another);
  CHECK(with_info([](CheckpointInfo& i) { i.step = -3; }) == "a.curlew is damaged: its step is -3" + take_another);
  CHECK(with_info([](CheckpointInfo& i) { i.numbers[0].second = not_a_number; }) ==
        "a.curlew is damaged: its number \"guard_scale\" is not finite" + take_another);
}
