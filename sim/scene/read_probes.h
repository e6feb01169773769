// Probes as scenes write them: {"name": "gauge", "pressure": {"at": [0, 0.1, 0]}, "every": 0.01}.
#pragma once

#include <vector>

#include "sim/scene/json_place.h"
#include "sim/scene/scene.h"

namespace curlew {

// The scene holds dimension, gravity and domain already. Throws InputError where a probe makes no sense or lies outside
// the domain.
std::vector<Probe> read_probes(const JsonPlace& place, const Scene& scene);

}  // namespace curlew
