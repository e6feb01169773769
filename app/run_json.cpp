#include "app/run_json.h"

#include <omp.h>

#include "app/commands.h"
#include "sim/io/atomic_file.h"
#include "sim/scene/json.h"
#include "sim/scene/reader.h"

namespace curlew {
namespace {

JsonNode number(std::int64_t value) { return JsonNode::of(static_cast<double>(value)); }

}  // namespace

void write_run_json(const std::string& folder, const RunOptions& options, const World& world, const RunSummary& summary,
                    const GraphicsInfo* graphics) {
  JsonNode program = JsonNode::object();
  program.add("version", JsonNode::of(version_text()))
      .add("instruction_set", JsonNode::of(CURLEW_ISA_NAME))
      .add("compiler", JsonNode::of(__VERSION__))
      .add("threads", number(omp_get_max_threads()));
  if (graphics != nullptr) {
    program.add("renderer", JsonNode::of(graphics->renderer)).add("opengl", JsonNode::of(graphics->version));
  }
  JsonNode result = JsonNode::object();
  result.add("status", JsonNode::of(summary.status))
      .add("steps", number(world.step))
      .add("time", JsonNode::of(world.time))
      .add("particles", number(static_cast<std::int64_t>(world.count)))
      .add("body_samples", number(static_cast<std::int64_t>(world.bodies.count())))
      .add("solver_bytes", number(static_cast<std::int64_t>(allocated_bytes(world))))
      .add("frames", number(summary.frames))
      .add("wall_seconds", JsonNode::of(summary.wall_seconds));
  if (!summary.message.empty()) result.add("message", JsonNode::of(summary.message));
  JsonNode run = JsonNode::object();
  run.add("command", JsonNode::of(options.command))
      .add("seed", number(static_cast<std::int64_t>(world.seed)))
      .add("program", program)
      .add("result", result);
  if (!summary.resumed_from.empty()) {
    run.add("resumed_from", JsonNode::of(summary.resumed_from))
        .add("changed_on_resume", JsonNode::of(summary.changed_on_resume));
  }
  run.add("scene", parse_json(scene_json(world.scene), world.scene.file));
  AtomicFile file(folder + "/run.json");
  file.write(json_text(run) + "\n");
  file.commit();
}

}  // namespace curlew
