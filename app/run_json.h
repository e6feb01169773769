// run.json: what ran, with what, and how it ended.
#pragma once

#include <string>

#include "app/options.h"
#include "render/context.h"
#include "sim/core/world.h"

namespace curlew {

struct RunSummary {
  std::string status = "running";  // running, done, interrupted, diverged, failed
  std::string message;             // of a run that diverged or failed
  std::int64_t frames = 0;
  double wall_seconds = 0;
  std::string resumed_from;        // checkpoint, or empty
  bool changed_on_resume = false;  // a --set came with --resume: no longer the same bits
};

void write_run_json(const std::string& folder, const RunOptions& options, const World& world, const RunSummary& summary,
                    const GraphicsInfo* graphics);

}  // namespace curlew
