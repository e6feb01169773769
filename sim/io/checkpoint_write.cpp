#include <xxhash.h>

#include <cstring>
#include <memory>
#include <stdexcept>

#include "sim/io/atomic_file.h"
#include "sim/io/checkpoint.h"
#include "sim/io/checkpoint_format.h"
#include "sim/io/checkpoint_payload.h"

namespace curlew {
namespace {

using namespace checkpoint_format;

template <class T>
void append(std::string& bytes, T number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof raw);
}

void append_text(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

std::string header(const CheckpointInfo& info, const Fields& fields) {
  std::string bytes;
  for (const auto* text : {&info.scene_json, &info.scene_file, &info.program_version, &info.isa}) {
    append_text(bytes, *text);
  }
  append(bytes, info.seed);
  append(bytes, info.step);
  append(bytes, info.time);
  append(bytes, info.dt);
  append(bytes, static_cast<std::uint32_t>(info.numbers.size()));
  for (const auto& [name, value] : info.numbers) {
    append_text(bytes, name);
    append(bytes, value);
  }
  const std::uint64_t particles = fields.id.size();
  append(bytes, particles);
  std::uint32_t count = 0;
  for_each_kept_field(fields, [&](const FieldRow&, const auto&) { ++count; });
  append(bytes, count);
  for_each_kept_field(fields, [&](const FieldRow& row, const auto& array) {
    if (array.size() != particles && !array.empty()) {
      throw std::logic_error("checkpoint: " + std::string(row.name) + " has another length than id");
    }
    append_text(bytes, row.name);
    append_text(bytes, row.type);
    append(bytes, std::uint64_t{array.size()});
  });
  return bytes;
}

struct HashDeleter {
  void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
};

}  // namespace

void write_checkpoint(const std::string& path, const CheckpointInfo& info, const Fields& fields) {
  const std::string head = header(info, fields);
  const std::vector<std::byte> payload = compress_kept_fields(fields);
  std::string prefix(magic);
  append(prefix, version);
  append(prefix, static_cast<std::uint32_t>(head.size()));
  append(prefix, std::uint64_t{payload.size()});

  const std::unique_ptr<XXH64_state_t, HashDeleter> hash(XXH64_createState());
  if (!hash) throw std::bad_alloc();
  XXH64_reset(hash.get(), 0);
  AtomicFile file(path);
  const auto put = [&](std::span<const std::byte> bytes) {
    XXH64_update(hash.get(), bytes.data(), bytes.size());
    file.write(bytes);
  };
  put(std::as_bytes(std::span(prefix)));
  put(std::as_bytes(std::span(head)));
  put(payload);
  const std::uint64_t checksum = XXH64_digest(hash.get());
  file.write(std::as_bytes(std::span(&checksum, 1)));
  file.commit(AtomicFile::Durability::power_cut);
}

}  // namespace curlew
