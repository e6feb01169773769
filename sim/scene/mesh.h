// Triangle meshes from files: OBJ, PLY and STL, joined, checked, and refused where they are not closed.
#pragma once

#include <filesystem>
#include <string>

#include "sim/scene/scene.h"

namespace curlew {

// Loads .obj, .ply or .stl (at most 512 MiB); vertices at the same place become one, triangles that name a vertex twice
// are dropped, and a closed mesh that is inside out is turned. Throws InputError where the file is missing, empty, cut
// short, of an unknown kind, or holds no triangle or a vertex that is not finite.
TriangleMesh load_mesh(const std::filesystem::path& file);

// Throws InputError unless every edge belongs to exactly two triangles; `place` begins the message.
void require_closed(const TriangleMesh&, const std::string& place);

// Scaled, then rotated about x, y and z in turn (degrees), then moved.
TriangleMesh transformed(TriangleMesh, double scale, Vec3d rotation, Vec3d translation);

// Volume (m^3) inside a closed mesh, from the divergence theorem; positive where the normals point outwards.
double signed_volume(const TriangleMesh&);

// Surface area (m^2).
double surface_area(const TriangleMesh&);

}  // namespace curlew
