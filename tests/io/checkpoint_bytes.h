// A checkpoint as bytes that a test can damage and seal again, so that its checksum is right.
#pragma once

#include <xxhash.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "sim/io/checkpoint.h"
#include "tests/io/sample_fields.h"
#include "tests/io/temporary_folder.h"

namespace curlew::test {

inline CheckpointInfo sample_info() {
  CheckpointInfo info;
  info.scene_json = "{\"curlew\": 1}";
  info.scene_file = "scenes/dam_break.json";
  info.program_version = "0.1.0";
  info.isa = "avx2";
  info.seed = 42;
  info.step = 1234567890123;
  info.time = 0.1;
  info.dt = 1.0 / 3;
  info.numbers = {{"guard_scale", 0.999}, {"loss", -1e-300}};
  return info;
}

struct CheckpointBytes {
  std::string bytes;

  explicit CheckpointBytes(std::string text) : bytes(std::move(text)) {}
  CheckpointBytes(const CheckpointInfo& info, const Fields& fields) {
    const TemporaryFolder folder;
    write_checkpoint(folder / "a.curlew", info, fields);
    bytes = file_text(folder / "a.curlew");
  }

  template <class T>
  CheckpointBytes& put(std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return *this;
  }
  std::size_t find(std::string_view text) const { return bytes.find(text); }

  // After the name and the type of a field comes its number of values; before the first field, theirs and the
  // particles'.
  CheckpointBytes& put_values(std::string_view name, std::string_view type, std::uint64_t values) {
    return put(find(name) + name.size() + 4 + type.size(), values);
  }
  CheckpointBytes& put_particles(std::uint64_t particles) { return put(find("position") - 16, particles); }
  CheckpointBytes& put_field_count(std::uint32_t fields) { return put(find("position") - 8, fields); }
  CheckpointBytes& rename(std::string_view from, std::string_view to) {
    bytes.replace(find(from), from.size(), to);
    return *this;
  }
  std::size_t payload() const {
    std::uint32_t header = 0;
    std::memcpy(&header, bytes.data() + 12, sizeof header);
    return 24 + header;
  }

  CheckpointBytes& seal() {
    const std::size_t covered = bytes.size() - 8;
    return put(covered, std::uint64_t{XXH64(bytes.data(), covered, 0)});
  }

  Checkpoint read() const { return read_checkpoint(std::as_bytes(std::span(bytes)), "a.curlew"); }
  std::string error() const {
    return input_error([&] { read(); });
  }
};

}  // namespace curlew::test
