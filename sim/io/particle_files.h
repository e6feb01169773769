// Particles as files for other programs, one file a frame, each written whole or not at all (atomic_file.h).
//
// VTK: legacy format 3.0, binary, https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html
// PLY: Greg Turk, The PLY Polygon File Format, 1994
// bgeo: Houdini's classic binary geometry, version 5, as Partio (Disney, github.com/wdas/partio) reads it
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/core/vec.h"

namespace curlew {

// A field beside those that every file holds: one number or three a particle. The name has letters, digits and _.
struct ExtraField {
  std::string name;
  std::variant<std::span<const float>, std::span<const Vec3>> values;
};

// What a frame holds. Nothing is copied: the arrays stay the caller's, all in the same order, which is the file's.
struct ParticleExport {
  double time = 0;        // s
  std::int64_t step = 0;  // of the solver
  std::span<const std::uint32_t> id;
  std::span<const Vec3> position, velocity;  // m, m/s
  std::span<const float> density;            // kg/m^3
  std::vector<ExtraField> extra;
};

// All throw InputError where the file cannot be written, std::logic_error where the arrays differ in length.

// POLYDATA with a vertex a particle, so that viewers show points at once; velocity, density, id and the extra fields as
// point data, TIME and CYCLE as field data.
void write_vtk(const std::string& path, const ParticleExport&);

// Binary little endian: x y z vx vy vz density id, then the extra fields (three numbers as name_x name_y name_z).
void write_ply(const std::string& path, const ParticleExport&);

// P (with w = 1), v, density, id, then the extra fields. The format has no place for the time.
void write_bgeo(const std::string& path, const ParticleExport&);

}  // namespace curlew
