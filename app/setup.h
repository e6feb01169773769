// From a command line to a scene that is ready to be laid out.
#pragma once

#include "app/options.h"
#include "sim/scene/scene.h"

namespace curlew {

// Reads the scene (file or bundled name) and applies --set, --radius and --particles.
Scene scene_from(const RunOptions& options);

// key=value texts, in order.
void apply_settings(Parameters& parameters, const std::vector<std::string>& settings);

}  // namespace curlew
