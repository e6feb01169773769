// PLY, see particle_files.h.
#include "sim/core/params.h"
#include "sim/io/atomic_file.h"
#include "sim/io/particle_columns.h"

namespace curlew {
namespace {

// Names that other programs know, without a prefix for the position.
std::string property_names(const Column& column) {
  if (column.words == 1) {
    return std::string("property ") + (column.is_integer ? "uint " : "float ") + column.name + "\n";
  }
  const std::string prefix = column.name == "position" ? "" : column.name == "velocity" ? "v" : column.name + "_";
  std::string text;
  for (const char axis : {'x', 'y', 'z'}) text += "property float " + prefix + axis + "\n";
  return text;
}

}  // namespace

void write_ply(const std::string& path, const ParticleExport& particles) {
  const std::vector<Column> columns = particle_columns(particles, path);
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment Curlew, time " + number_text(particles.time) +
                       " s, step " + std::to_string(particles.step) + "\nelement vertex " +
                       std::to_string(particles.id.size()) + "\n";
  for (const Column& column : columns) header += property_names(column);
  AtomicFile file(path);
  file.write(header + "end_header\n");
  write_records(file, columns, particles.id.size(), std::endian::little);
  file.commit();
}

}  // namespace curlew
