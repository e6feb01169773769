// The particle arrays as columns of 32-bit words: what the file formats differ in is the header, the order of the bytes
// and which columns make a record.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "sim/io/particle_files.h"

namespace curlew {

class AtomicFile;

struct Column {
  std::string name;  // "position", "velocity", "density", "id" and the extra fields, in this order
  bool is_integer = false;
  std::size_t words = 1;             // 1 or 3
  const std::byte* first = nullptr;  // of particle 0
  std::size_t stride = 4;            // bytes from one particle to the next
};

// Throws std::logic_error where the arrays differ in length, InputError where there are more particles than `path` can
// hold (the formats count in 32 bits).
std::vector<Column> particle_columns(const ParticleExport&, const std::string& path);

// Writes for each particle the words of each column, in the byte order asked for.
void write_records(AtomicFile&, std::span<const Column>, std::size_t particles, std::endian order);

// Appends the bytes of a number in the byte order asked for.
template <class T>
void append_number(std::string& bytes, T value, std::endian order) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (order == std::endian::native) {
    bytes.append(raw, sizeof raw);
  } else {
    for (std::size_t i = sizeof raw; i-- > 0;) bytes += raw[i];
  }
}

}  // namespace curlew
