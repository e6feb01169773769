// From a command line to a scene that is ready to be laid out.
#pragma once

#include <string>

#include "app/options.h"
#include "sim/scene/scene.h"

namespace curlew {

// Reads the scene (file or bundled name) and applies --set, --radius and --particles.
Scene scene_from(const RunOptions& options);

// key=value texts, in order.
void apply_settings(Parameters& parameters, const std::vector<std::string>& settings);

// What is odd about the colours that the scene asks for: they show a model that is off, and so are 0 everywhere. Empty
// where nothing is.
std::string colour_warning(const Scene& scene);

}  // namespace curlew
