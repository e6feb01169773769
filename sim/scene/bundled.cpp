#include "sim/scene/bundled.h"

#include <algorithm>
#include <system_error>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json_place.h"

namespace curlew {
namespace {

std::vector<std::filesystem::path> scene_files(const std::filesystem::path& assets_dir) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  std::filesystem::directory_iterator entry(assets_dir / "scenes", error), end;
  if (error) {
    throw InputError((assets_dir / "scenes").string() + ": cannot be read (" + error.message() +
                     "), expected the folder of the bundled scenes");
  }
  for (; entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<SceneInfo> bundled_scenes(const std::filesystem::path& assets_dir) {
  std::vector<SceneInfo> scenes;
  for (const auto& file : scene_files(assets_dir)) {
    constexpr std::uintmax_t largest = 4U << 20U;
    const JsonNode tree = parse_json(read_file(file, largest, "a scene file"), file);
    const auto about = JsonPlace(tree, file).find("about");
    scenes.push_back({file.stem().string(), about ? about->text() : "", file});
  }
  return scenes;
}

std::filesystem::path find_scene(const std::string& name_or_path, const std::filesystem::path& assets_dir) {
  const std::filesystem::path path(name_or_path);
  std::error_code error;
  const bool is_name = name_or_path.find('/') == std::string::npos && path.extension() != ".json";
  std::vector<std::string> names;
  for (const auto& file : scene_files(assets_dir)) {
    if (is_name && file.stem() == path) return file;
    names.push_back(file.stem().string());
  }
  if (std::filesystem::exists(path, error)) return path;
  const std::string near = nearest_name(is_name ? name_or_path : path.stem().string(), names);
  throw InputError("there is no scene " + in_quotes(name_or_path) +
                   (near.empty() ? ", expected a file or a name that `curlew scenes` lists"
                                 : "; did you mean the bundled scene \"" + near + "\"?"));
}

}  // namespace curlew
