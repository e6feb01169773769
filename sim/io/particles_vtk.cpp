// Legacy VTK, see particle_files.h. Binary data is big endian in this format.
#include "sim/core/params.h"
#include "sim/io/atomic_file.h"
#include "sim/io/particle_columns.h"

namespace curlew {
namespace {

// Step numbers are wider than VTK's int; ParaView shows a double whole up to 2^53.
std::string header(const ParticleExport& particles) {
  std::string text = "# vtk DataFile Version 3.0\nCurlew, time " + number_text(particles.time) + " s, step " +
                     std::to_string(particles.step) +
                     "\nBINARY\nDATASET POLYDATA\nFIELD FieldData 2\nTIME 1 1 double\n";
  append_number(text, particles.time, std::endian::big);
  text += "\nCYCLE 1 1 double\n";
  append_number(text, static_cast<double>(particles.step), std::endian::big);
  return text + "\nPOINTS " + std::to_string(particles.id.size()) + " float\n";
}

// A cell (1, i) for each point: filters such as Threshold work on cells.
void write_vertices(AtomicFile& file, std::size_t particles) {
  file.write("\nVERTICES " + std::to_string(particles) + " " + std::to_string(2 * particles) + "\n");
  std::string cells;
  for (std::size_t i = 0; i < particles; ++i) {
    append_number(cells, std::uint32_t{1}, std::endian::big);
    append_number(cells, static_cast<std::uint32_t>(i), std::endian::big);
    if (cells.size() == 8192 || i + 1 == particles) {
      file.write(cells);
      cells.clear();
    }
  }
}

// Scalars and vectors get VTK's own attributes, so that a viewer offers to colour by them and draws arrows.
std::string attribute_header(const Column& column) {
  if (column.words == 3) return "\nVECTORS " + column.name + " float\n";
  return "\nSCALARS " + column.name + (column.is_integer ? " unsigned_int" : " float") + " 1\nLOOKUP_TABLE default\n";
}

}  // namespace

void write_vtk(const std::string& path, const ParticleExport& particles) {
  const std::vector<Column> columns = particle_columns(particles, path);
  const std::size_t count = particles.id.size();
  AtomicFile file(path);
  file.write(header(particles));
  write_records(file, std::span(columns).first(1), count, std::endian::big);
  write_vertices(file, count);
  file.write("\nPOINT_DATA " + std::to_string(count));
  for (const Column& column : std::span(columns).subspan(1)) {
    file.write(attribute_header(column));
    write_records(file, {&column, 1}, count, std::endian::big);
  }
  file.write("\n");
  file.commit();
}

}  // namespace curlew
