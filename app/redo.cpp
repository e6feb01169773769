// `curlew mesh` and `curlew render`: the surface, or the pictures, of a finished run again from its particle files.
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/assets.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/setup.h"
#include "sim/core/error.h"
#include "sim/io/particle_read.h"
#include "sim/scene/bundled.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json.h"
#include "sim/scene/reader.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;

// The scene of a run, as run.json has it.
Scene scene_of_run(const fs::path& folder) {
  const fs::path file = folder / "run.json";
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": there is no such folder, expected one of a run");
  const JsonNode run = parse_json(read_file(file, 100'000'000, "a run's run.json"), file);
  for (std::size_t k = 0; k < run.keys.size(); ++k) {
    if (run.keys[k] == "scene") return parse_scene(json_text(run.items[k]), file);
  }
  throw InputError(file.string() + ": has no \"scene\", expected the run.json of a run");
}

struct SavedFrame {
  fs::path file;
  std::int64_t number;
};

// The particle files of a run, in their order.
std::vector<SavedFrame> saved_frames(const fs::path& folder) {
  std::vector<SavedFrame> frames;
  std::error_code ignored;
  for (fs::directory_iterator at(folder / "particles", ignored), end; !ignored && at != end; at.increment(ignored)) {
    const std::string stem = at->path().stem().string(), kind = at->path().extension().string();
    const bool numbered = !stem.empty() && stem.find_first_not_of("0123456789") == std::string::npos;
    if (numbered && stem.size() < 18 && (kind == ".vtk" || kind == ".ply" || kind == ".bgeo"))
      frames.push_back({at->path(), std::stoll(stem)});
  }
  if (frames.empty()) {
    throw InputError(folder.string() + " has no particle files; run the scene with --particles-out, for example vtk");
  }
  std::sort(frames.begin(), frames.end(), [](const SavedFrame& a, const SavedFrame& b) { return a.file < b.file; });
  return frames;
}

void make_room(const fs::path& folder, const std::string& kind, bool overwrite) {
  std::error_code ignored;
  if (fs::is_directory(folder, ignored) && !fs::is_empty(folder, ignored) && !overwrite) {
    throw InputError(folder.string() + " holds " + kind + " already; give --overwrite to replace them");
  }
}

// Of the fields that colour particles, those that particle files have.
void check_colour(const Look& look) {
  for (const char* name : {"none", "speed", "height", "density"}) {
    if (look.colour_by == name) return;
  }
  throw InputError("particle files do not have " + look.colour_by +
                   ", expected look.colour_by none, speed, height or density; give another with --view");
}

int redo(const RedoOptions& options, const Scene& scene, const RunOptions& wanted) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  const std::vector<SavedFrame> frames = saved_frames(options.folder);
  FrameOutput output(wanted, scene, options.folder, {});
  World world = make_empty_world(scene);
  Progress progress(options.quiet);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    ParticleSet set = read_particles(frames[k].file);
    world.count = set.position.size();
    world.time = set.time.value_or(static_cast<double>(frames[k].number) / options.fps);
    world.step = set.step.value_or(frames[k].number);
    world.fields.id.assign(set.id.begin(), set.id.end());
    world.fields.position.assign(set.position.begin(), set.position.end());
    world.fields.velocity.assign(set.velocity.begin(), set.velocity.end());
    world.fields.density.assign(set.density.begin(), set.density.end());
    output.write(world, frames[k].number);
    progress.show(static_cast<double>(k + 1) / static_cast<double>(frames.size()), frames[k].file.string());
  }
  progress.finish();
  output.finish();
  if (!options.quiet) std::printf("%zu frames of %s\n", frames.size(), options.folder.c_str());
  return 0;
}

}  // namespace

int mesh_command(const RedoOptions& options) {
  Scene scene = scene_of_run(options.folder);
  apply_settings(scene.parameters, options.settings);
  RunOptions wanted;
  wanted.mesh_out = options.mesh_out;
  make_room(fs::path(options.folder) / "mesh", "meshes", options.overwrite);
  return redo(options, scene, wanted);
}

int render_command(const RedoOptions& options) {
  Scene scene = scene_of_run(options.folder);
  apply_settings(scene.parameters, options.settings);
  if (!options.view.empty()) {
    const Scene view = read_scene(find_scene(options.view, assets_folder()));
    scene.camera = view.camera;
    scene.look = view.look;
  }
  if (options.look) scene.look.style = *options.look;
  if (scene.look.style == LookStyle::particles) check_colour(scene.look);
  RunOptions wanted;
  wanted.frames = true;
  wanted.video = options.video;
  wanted.fps = options.fps;
  wanted.width = options.width;
  wanted.height = options.height;
  wanted.quiet = options.quiet;
  make_room(fs::path(options.folder) / "frames", "frames", options.overwrite);
  return redo(options, scene, wanted);
}

}  // namespace curlew
