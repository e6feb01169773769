// `curlew check`, `scenes`, `params`, `doctor` and `--version`: what there is, before anything runs.
#include <omp.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#if defined(CURLEW_GUI)
#include <GLFW/glfw3.h>
#endif

#include "app/assets.h"
#include "app/commands.h"
#include "app/setup.h"
#include "render/context.h"
#include "sim/core/error.h"
#include "sim/core/passes.h"
#include "sim/scene/bundled.h"
#include "sim/scene/json.h"
#include "sim/scene/resolution.h"
#include "sim/scene/schema.h"

namespace curlew {
namespace {

const char* type_text(ParameterRow::Type type) {
  switch (type) {
    case ParameterRow::Type::real:
      return "number";
    case ParameterRow::Type::count:
      return "integer";
    case ParameterRow::Type::flag:
      return "boolean";
    case ParameterRow::Type::choice:
      return "choice";
  }
  return "";
}

JsonNode value_node(const ParameterRow& row, double value) {
  if (row.type == ParameterRow::Type::flag) return JsonNode::of(value != 0);
  if (row.type == ParameterRow::Type::choice) return JsonNode::of(parameter_text(row, value));
  return JsonNode::of(value);
}

JsonNode parameter_node(const ParameterRow& row) {
  JsonNode node = JsonNode::object();
  node.add("key", JsonNode::of(row.key)).add("type", JsonNode::of(type_text(row.type)));
  node.add("default", value_node(row, row.default_value));
  const bool ranged = row.type == ParameterRow::Type::real || row.type == ParameterRow::Type::count;
  const auto bound = [&](double value) { return ranged ? JsonNode::of(value) : JsonNode{}; };
  node.add("min", bound(row.min)).add("max", bound(row.max));
  node.add("slider_min", bound(row.slider_min)).add("slider_max", bound(row.slider_max));
  node.add("unit", JsonNode::of(row.unit)).add("symbol", JsonNode::of(row.symbol));
  node.add("doc", JsonNode::of(row.doc)).add("live", JsonNode::of(row.live));
  if (row.type == ParameterRow::Type::choice) {
    JsonNode names = JsonNode::array();
    for (const std::string& name : row.names) names.add(JsonNode::of(name));
    node.add("choices", names);
  }
  return node;
}

std::string range_text(const ParameterRow& row) {
  if (row.type == ParameterRow::Type::flag) return "true, false";
  if (row.type == ParameterRow::Type::choice) {
    std::string all;
    for (const std::string& name : row.names) all += (all.empty() ? "" : ", ") + name;
    return all;
  }
  return number_text(row.min) + " to " + number_text(row.max);
}

std::string unit_text(const ParameterRow& row) { return row.unit == "1" ? "" : row.unit; }

void print_markdown() {
  std::printf("| parameter | default | range | unit | symbol | live | what it does |\n|---|---|---|---|---|---|---|\n");
  for (const ParameterRow& row : parameter_table()) {
    std::printf("| `%s` | %s | %s | %s | %s | %s | %s |\n", row.key.c_str(),
                parameter_text(row, row.default_value).c_str(), range_text(row).c_str(), unit_text(row).c_str(),
                row.symbol.c_str(), row.live ? "yes" : "no", row.doc.c_str());
  }
}

void print_text() {
  std::string heading;
  for (const ParameterRow& row : parameter_table()) {
    if (row.heading != heading) std::printf("%s%s\n", heading.empty() ? "" : "\n", row.heading.c_str());
    heading = row.heading;
    std::printf("  %s = %s %s  (%s%s)\n      %s\n", row.key.c_str(), parameter_text(row, row.default_value).c_str(),
                unit_text(row).c_str(), range_text(row).c_str(), row.live ? "" : "; needs a restart", row.doc.c_str());
  }
}

std::string program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    const std::string file = rest.substr(0, colon) + "/" + name;
    if (access(file.c_str(), X_OK) == 0) return file;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return "";
}

std::string window_text() {
#if defined(CURLEW_GUI)
  if (glfwInit() != GLFW_TRUE) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return std::string("none: ") + (reason != nullptr ? reason : "no display");
  }
  const std::string version = glfwGetVersionString();
  glfwTerminate();
  return "display found, GLFW " + version;
#else
  return "built without one (CURLEW_GUI=OFF)";
#endif
}

}  // namespace

std::string version_text() { return std::string("curlew ") + CURLEW_VERSION + " (" + CURLEW_COMMIT + ")"; }

int scenes_command() {
  for (const SceneInfo& scene : bundled_scenes(assets_folder())) {
    std::printf("%-16s %s\n", scene.name.c_str(), scene.about.c_str());
  }
  return 0;
}

int params_command(ParameterFormat format) {
  switch (format) {
    case ParameterFormat::text:
      print_text();
      break;
    case ParameterFormat::markdown:
      print_markdown();
      break;
    case ParameterFormat::schema:
      std::printf("%s", scene_schema().c_str());
      break;
    case ParameterFormat::json: {
      JsonNode list = JsonNode::array();
      for (const ParameterRow& row : parameter_table()) list.add(parameter_node(row));
      std::printf("%s\n", json_text(list).c_str());
    }
  }
  return 0;
}

int check_command(const RunOptions& options) {
  const Scene scene = scene_from(options);
  World world = make_world(scene);
  const Plan plan = make_plan(world);
  prepare(world, plan);
  std::printf("%s: %s\n", scene.file.string().c_str(), scene.name.c_str());
  std::printf("  %dD, particle radius %s m, spacing %s m\n", scene.dimension,
              number_text(scene.particle_radius).c_str(), number_text(scene.spacing()).c_str());
  std::printf("  %zu fluid particles, %zu bodies with %zu samples, %.1f neighbours a particle\n", world.count,
              scene.bodies.size(), world.bodies.count(),
              static_cast<double>(world.neighbours.pairs()) / static_cast<double>(world.count));
  for (const Body& body : scene.bodies) {
    if (!body.motion.moves()) continue;
    const std::vector<Keyframe>& keyframes = body.motion.keyframes();
    std::printf("  %s moves from %s s to %s s, at most at %.3g m/s\n", body.name.c_str(),
                number_text(keyframes.front().time).c_str(), number_text(keyframes.back().time).c_str(),
                body.motion.top_speed());
  }
  std::printf("  %s for the solver, %.0f bytes a particle\n",
              bytes_text(static_cast<double>(allocated_bytes(world))).c_str(),
              static_cast<double>(allocated_bytes(world)) / static_cast<double>(world.count));
  std::printf("  first time step %.3g s; density beyond rest: mean %.2g %%, largest %.2g %%\n", world.dt,
              100 * world.report.density_error_true_avg, 100 * world.report.density_error_true_max);
  if (const std::string warning = colour_warning(scene); !warning.empty()) std::printf("  %s\n", warning.c_str());
  std::printf("  passes:");
  for (const Pass* pass : plan.step) std::printf(" %s", std::string(pass->name).c_str());
  std::printf("\n");
  return 0;
}

int doctor_command() {
  std::printf("%s, built with %s for %s\n", version_text().c_str(), __VERSION__, CURLEW_ISA_NAME);
  std::printf("processor: %d threads, %s of memory\n", omp_get_num_procs(), bytes_text(machine_memory()).c_str());
  bool draws = true;
  try {
    const OffscreenContext context;
    const GraphicsInfo& info = context.info();
    std::printf("off-screen frames: yes, %s, %s, OpenGL %s\n", info.platform.c_str(), info.renderer.c_str(),
                info.version.c_str());
  } catch (const GraphicsError& error) {
    std::printf("off-screen frames: no: %s\n", error.what());
    draws = false;
  }
  const std::string ffmpeg = program_on_path("ffmpeg");
  std::printf("video: %s\n", ffmpeg.empty() ? "no: ffmpeg is not on PATH; install it" : ("yes, " + ffmpeg).c_str());
  std::printf("window: %s\n", window_text().c_str());
  std::printf("assets: %s\n", assets_folder().string().c_str());
  return draws ? 0 : 4;
}

#if !defined(CURLEW_GUI)
int gui_command(const RunOptions&) {
  throw GraphicsError(
      "built without a window (CURLEW_GUI=OFF); run without one, for example: curlew run pillars --frames");
}
#endif

}  // namespace curlew
