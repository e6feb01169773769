// Checkpoints: the state from which a run goes on with the same bits. The kept fields are saved by name, bit for bit
// and in the order in which they are stored: sums run in that order, so it is part of the state.
//
// The file, little endian:
//   "CURLEWCP"
//   uint32 version of the format, uint32 bytes of the header, uint64 bytes of the payload
//   header: scene_json, scene_file, program_version, isa (texts); uint64 seed, int64 step, double time, dt;
//           uint32 n, then n times (text, double); uint64 particles;
//           uint32 n, then n fields: name, type (texts), uint64 values (as many as particles, or 0 where the field is
//           not in use)
//   payload: one zstd frame with the values of all fields in that order
//   uint64 xxHash64 of everything before it
// A text is a uint32 length and its bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/fields.h"

namespace curlew {

struct CheckpointInfo {
  std::string scene_json;  // the resolved scene, with every parameter
  std::string scene_file;  // where it came from; its folder is the base of relative paths
  std::string program_version, isa;
  std::uint64_t seed = 0;
  std::int64_t step = 0;
  double time = 0, dt = 0;                              // s
  std::vector<std::pair<std::string, double>> numbers;  // whatever else a run carries from step to step
};

struct Checkpoint : CheckpointInfo {
  Fields fields;  // the kept ones; those that were not in use, and scratch, are empty
};

// Writes `path` whole or not at all, and waits until the disk has it. A kept field has as many values as id, or none
// where it is not in use. Throws InputError where the file cannot be written.
void write_checkpoint(const std::string& path, const CheckpointInfo&, const Fields&);

// Throws InputError with one sentence naming the file where it is missing, not a checkpoint, from a newer program, cut
// off or damaged, or where its fields are not those of this program. A file from a stranger is safe to read: sizes are
// checked before memory is taken, and memory is used only as data arrives.
Checkpoint read_checkpoint(const std::string& path);

// The same from memory; `name` stands for the file in messages.
Checkpoint read_checkpoint(std::span<const std::byte> bytes, const std::string& name);

}  // namespace curlew
