// What a mesh file must fulfil before assimp sees it: assimp trusts the counts in a header and allocates by them.
#pragma once

#include <filesystem>

namespace curlew {

// Throws InputError for a missing, empty, too large (above 512 MiB) or unknown kind of file, for a header that promises
// more than the file holds, and for an STL or PLY file that is cut short.
void precheck_mesh_file(const std::filesystem::path& file);

}  // namespace curlew
