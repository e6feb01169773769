// Classic .bgeo, see particle_files.h. Everything is big endian:
//   "Bgeo" 'V' int32 version (5), points, primitives, point groups, primitive groups, point attributes, vertex
//   attributes, primitive attributes, detail attributes
//   for each point attribute: int16 length of the name, name, int16 numbers a point, int32 type (0 float, 1 int,
//   5 vector), a default value for each number
//   for each point: x y z w, then the attributes
//   0x00 0xff: beginning and end of the (empty) extra section
#include "sim/io/atomic_file.h"
#include "sim/io/particle_columns.h"

namespace curlew {
namespace {

std::string header(std::size_t points, std::span<const Column> attributes) {
  const auto append = [](std::string& text, auto value) { append_number(text, value, std::endian::big); };
  std::string bytes = "BgeoV";
  const std::int32_t numbers[] = {
      5, static_cast<std::int32_t>(points), 0, 0, 0, static_cast<std::int32_t>(attributes.size()), 0, 0, 0};
  for (const std::int32_t number : numbers) append(bytes, number);
  for (const Column& attribute : attributes) {
    // Houdini moves points by an attribute called v.
    const std::string name = attribute.name == "velocity" ? "v" : attribute.name;
    append(bytes, static_cast<std::int16_t>(name.size()));
    bytes += name;
    append(bytes, static_cast<std::int16_t>(attribute.words));
    append(bytes, std::int32_t{attribute.words == 3 ? 5 : attribute.is_integer ? 1 : 0});
    for (std::size_t i = 0; i < attribute.words; ++i) append(bytes, std::int32_t{0});
  }
  return bytes;
}

}  // namespace

void write_bgeo(const std::string& path, const ParticleExport& particles) {
  std::vector<Column> columns = particle_columns(particles, path);
  const std::string head = header(particles.id.size(), std::span(columns).subspan(1));

  // Points are homogeneous: a column of ones follows the position.
  const float one = 1;
  const Column w = {.name = "w", .first = std::as_bytes(std::span(&one, 1)).data(), .stride = 0};
  columns.insert(columns.begin() + 1, w);

  AtomicFile file(path);
  file.write(head);
  write_records(file, columns, particles.id.size(), std::endian::big);
  file.write(std::string_view("\x00\xff", 2));
  file.commit();
}

}  // namespace curlew
