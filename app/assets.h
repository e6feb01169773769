// Where scenes and meshes that come with the program lie.
#pragma once

#include <filesystem>

namespace curlew {

// The assets beside an installed program (../share/curlew), else those of the source tree that it was built from.
// Throws InputError where neither is there.
std::filesystem::path assets_folder();

}  // namespace curlew
