#include "sim/io/particle_columns.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "sim/core/error.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

template <class T>
Column column(std::string name, std::span<const T> values, std::size_t particles) {
  if (values.size() != particles) throw std::logic_error("particle export: " + name + " has another length than id");
  return {.name = std::move(name),
          .is_integer = std::is_integral_v<T>,
          .words = std::is_same_v<T, Vec3> ? std::size_t{3} : std::size_t{1},
          .first = std::as_bytes(values).data(),
          .stride = sizeof(T)};
}

std::uint32_t swap_bytes(std::uint32_t word) { return __builtin_bswap32(word); }

}  // namespace

std::vector<Column> particle_columns(const ParticleExport& particles, const std::string& path) {
  const std::size_t count = particles.id.size();
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError("cannot write " + path + ": " + std::to_string(count) +
                     " particles are more than the format can count");
  }
  std::vector<Column> columns = {column("position", particles.position, count),
                                 column("velocity", particles.velocity, count),
                                 column("density", particles.density, count), column("id", particles.id, count)};
  for (const ExtraField& extra : particles.extra) {
    columns.push_back(std::visit([&](auto values) { return column(extra.name, values, count); }, extra.values));
  }
  return columns;
}

void write_records(AtomicFile& file, std::span<const Column> columns, std::size_t particles, std::endian order) {
  std::size_t words = 0;
  for (const Column& column : columns) words += column.words;

  constexpr std::size_t block = 1024;  // particles; the block stays in the first cache while columns fill it in turn
  std::vector<std::uint32_t> records(block * words);
  for (std::size_t begin = 0; begin < particles; begin += block) {
    const std::size_t count = std::min(block, particles - begin);
    std::size_t at = 0;
    for (const Column& column : columns) {
      const std::byte* in = column.first + begin * column.stride;
      std::uint32_t* out = records.data() + at;
      for (std::size_t i = 0; i < count; ++i, in += column.stride, out += words) {
        std::memcpy(out, in, 4 * column.words);
      }
      at += column.words;
    }
    const std::span used(records.data(), count * words);
    if (order != std::endian::native) std::transform(used.begin(), used.end(), used.begin(), swap_bytes);
    file.write(std::as_bytes(used));
  }
}

}  // namespace curlew
