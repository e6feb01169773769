// libFuzzer's entry to the reader of checkpoints; .cc because it is no part of a suite of Catch tests. The checksum is
// put right first, or nothing would get past it.
//   clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -I. tests/io/fuzz_checkpoint.cc sim/io/*.cpp
//     sim/measure/state_hash.cpp sim/core/params.cpp -lzstd -lxxhash -o fuzz_checkpoint
//   ./fuzz_checkpoint -max_total_time=60 FOLDER_WITH_A_CHECKPOINT
#include <xxhash.h>

#include <cstring>
#include <vector>

#include "sim/core/error.h"
#include "sim/io/checkpoint.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  if (size >= 8) {
    const std::uint64_t checksum = XXH64(data, size - 8, 0);
    std::memcpy(bytes.data() + size - 8, &checksum, sizeof checksum);
  }
  try {
    curlew::read_checkpoint(bytes, "fuzz");
  } catch (const curlew::InputError&) {
  }
  return 0;
}
