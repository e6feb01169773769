// A world as a checkpoint: what `curlew run --resume` goes on from with the same bits.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/core/world.h"

namespace curlew {

// Writes the file whole or not at all; `numbers` is what else a run carries from step to step.
void save_checkpoint(const std::string& file, const World& world,
                     std::vector<std::pair<std::string, double>> numbers = {});

}  // namespace curlew
