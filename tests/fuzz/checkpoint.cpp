// libFuzzer's entry to the reader of checkpoints. The checksum is put right first, or nothing would get past it. What
// is read must be finite, and must read again to the same after it was written.
#include <xxhash.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "sim/core/error.h"
#include "sim/io/checkpoint.h"
#include "tests/fuzz/fuzz.h"
#include "tests/io/sample_fields.h"

using namespace curlew;

// An empty corpus begins with a checkpoint of a few particles: no chance would find the magic word.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::filesystem::path folder = test::corpus_folder(*argc, *argv);
  if (folder.empty() || !std::filesystem::is_empty(folder)) return 0;
  CheckpointInfo info;
  info.scene_json = "{}";
  info.scene_file = "a.json";
  info.program_version = "1";
  info.isa = "x";
  info.time = info.dt = 0.25;
  info.numbers = {{"colour_low", 0.0}};
  write_checkpoint((folder / "few.curlew").string(), info, test::sample_fields(3));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  if (size >= 8) {
    const std::uint64_t checksum = XXH64(data, size - 8, 0);
    std::memcpy(bytes.data() + size - 8, &checksum, sizeof checksum);
  }
  try {
    const Checkpoint checkpoint = read_checkpoint(bytes, "fuzz");
    for (const Vec3& x : checkpoint.fields.position) test::require(x.x - x.x == 0 && x.y - x.y == 0 && x.z - x.z == 0);
    test::require(checkpoint.step >= 0 && checkpoint.time >= 0);
  } catch (const InputError& error) {
    test::check_sentence(error.what());
  }
  return 0;
}
