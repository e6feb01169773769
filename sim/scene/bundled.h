// The scenes that come with the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curlew {

struct SceneInfo {
  std::string name;  // the file's name without .json: what `curlew run NAME` takes
  std::string about;
  std::filesystem::path path;
};

// All scenes in assets_dir/scenes, by name. Throws InputError where the folder or one of them cannot be read.
std::vector<SceneInfo> bundled_scenes(const std::filesystem::path& assets_dir);

// The file of a bundled scene's name, or the path itself where it names a file. Throws InputError with the nearest name
// where there is neither.
std::filesystem::path find_scene(const std::string& name_or_path, const std::filesystem::path& assets_dir);

}  // namespace curlew
