// The water's surface as files for other programs, one file a frame, each written whole or not at all (atomic_file.h).
//
// PLY: Greg Turk, The PLY Polygon File Format, 1994
// OBJ: Wavefront, Advanced Visualizer, Appendix B1, Object Files
#pragma once

#include <cstdint>
#include <string>

#include "sim/surface/surface_mesh.h"

namespace curlew {

// Binary little endian: x y z nx ny nz, and vx vy vz where the mesh has velocities; triangles as vertex_indices. Throws
// InputError where the file cannot be written.
void write_mesh_ply(const std::string& path, const SurfaceMesh& mesh, double time, std::int64_t step);

// Text: v, vn and f. The format has no place for velocities.
void write_mesh_obj(const std::string& path, const SurfaceMesh& mesh, double time, std::int64_t step);

}  // namespace curlew
