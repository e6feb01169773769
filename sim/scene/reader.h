// Scene files: strict reading, and writing of the resolved scene.
#pragma once

#include <filesystem>
#include <string>

#include "sim/scene/scene.h"

namespace curlew {

// Reads a scene file (JSON, see assets/scene.schema.json; at most 4 MiB), with its meshes and heightfields. Throws
// InputError: one sentence with the file, the place, what was found and what was expected. What depends on the particle
// radius is checked by check_resolution, because --radius and --particles come later.
Scene read_scene(const std::filesystem::path& file);

// The same from text; `file` stands in messages, and mesh paths are relative to its folder.
Scene parse_scene(const std::string& json_text, const std::filesystem::path& file);

// The whole scene with every parameter as JSON that parse_scene reads back to the same scene. Paths of meshes and
// heightfields are written absolute, so that the text works from any folder.
std::string scene_json(const Scene&);

}  // namespace curlew
