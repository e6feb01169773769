// Readers of triangle meshes, one a format. They are our own because the files come from anywhere: assimp 5.2.5, tried
// first, hung, crashed or aborted on one damaged file in a few hundred (a PLY header that breaks off, an ASCII PLY with
// a wrong count), which no check before it could rule out.
#pragma once

#include <filesystem>
#include <string_view>

#include "sim/scene/scene.h"

namespace curlew {

// Each takes the whole text or bytes of a file and returns what stands in it: vertices not joined, polygons cut into
// fans, normals, colours and texture places left out. They throw InputError with the file and the place where something
// is missing, is no number, is not finite, or names a vertex that the file does not hold.
TriangleMesh read_obj(std::string_view text, const std::filesystem::path& file);  // v and f lines
TriangleMesh read_ply(std::string_view text, const std::filesystem::path& file);  // ascii, both binary kinds
TriangleMesh read_stl(std::string_view text, const std::filesystem::path& file);  // ascii and binary

}  // namespace curlew
