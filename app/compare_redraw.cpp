// The middle layer of `curlew compare`: GOLDEN's checkpoints drawn again by this program, against the pictures that
// GOLDEN drew of the same states.
//
// A checkpoint is the state to the last bit; what depends on it alone (neighbours, densities) is found again as for
// --resume, so on the same renderer the same code gives the same picture. Elsewhere rasterisers round differently, and
// nothing could be said under a tight tolerance.
#include <algorithm>
#include <cstdio>

#include "app/compare.h"
#include "render/context.h"
#include "render/png.h"
#include "render/renderer.h"
#include "sim/core/error.h"
#include "sim/core/frame.h"
#include "sim/core/passes.h"
#include "sim/io/checkpoint.h"
#include "sim/scene/reader.h"
#include "sim/surface/surface.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_states = 12;  // evenly over the run: each costs a surface and a picture

constexpr const char* no_state =
    "GOLDEN has no checkpoint of a moment that one of its pictures shows. With some, its states would be drawn again "
    "here, which tells a change of the rendering from one of the simulation: run it with --frames and "
    "--checkpoint-every as long as one frame or several.";

// A checkpoint of a state that a picture shows.
struct StoredState {
  std::string checkpoint, frame;
};

fs::path checkpoint_file(const RunRecord& golden, const std::string& name) {
  return golden.folder / "checkpoints" / name;
}

// The picture of the checkpoint's step. A frame shows the first state at or past its time: where the step before was
// that far already, the frame is of an earlier state.
std::optional<std::string> frame_of(const CheckpointInfo& state, const RunRecord& golden, double fps) {
  const double frame = frame_at(state.time, fps);
  if (frame_at(state.time - state.dt, fps) == frame) return std::nullopt;
  char name[32];
  std::snprintf(name, sizeof name, "%06.0f.png", frame);
  const bool drawn = std::find(golden.frames.begin(), golden.frames.end(), name) != golden.frames.end();
  return drawn ? std::optional<std::string>(name) : std::nullopt;
}

// Reads all checkpoints, so that a damaged one is found on any machine.
std::vector<StoredState> stored_states(const RunRecord& golden) {
  std::vector<StoredState> states;
  const std::optional<double> fps = golden.fps();
  for (const std::string& name : golden.checkpoints) {
    const Checkpoint checkpoint = read_checkpoint(checkpoint_file(golden, name).string());
    const auto frame = fps ? frame_of(checkpoint, golden, *fps) : std::nullopt;
    if (frame) states.push_back({name, *frame});
  }
  return states;
}

std::vector<StoredState> spread_out(const std::vector<StoredState>& all) {
  if (all.size() <= most_states) return all;
  std::vector<StoredState> some;
  for (std::size_t k = 0; k < most_states; ++k) some.push_back(all[k * (all.size() - 1) / (most_states - 1)]);
  return some;
}

World world_of(Checkpoint& state) {
  World world = make_empty_world(parse_scene(state.scene_json, state.scene_file), state.seed);
  world.fields = std::move(state.fields);
  world.count = world.fields.id.size();
  world.step = state.step;
  world.time = state.time;
  world.dt = state.dt;
  return world;
}

// What the pictures show of the world, beside what a checkpoint has.
void fill_fields(World& world) {
  const FieldSet shown = shown_demand(world.scene.look, world.scene.dimension);
  if (shown.meets(FieldSet::of(FieldKind::carried)))
    throw InputError("they are coloured by " + world.scene.look.colour_by + ", which checkpoints do not hold");
  prepare(world, make_plan(world, shown));
}

// The colour scale of a scene that does not fix it: what the run had seen so far.
std::optional<std::array<double, 2>> colour_range(const Checkpoint& state) {
  std::optional<double> low, high;
  for (const auto& [name, value] : state.numbers) {
    if (name == "colour_low") low = value;
    if (name == "colour_high") high = value;
  }
  return low && high ? std::optional(std::array{*low, *high}) : std::nullopt;
}

// As the run drew it (FrameOutput::write).
Image draw_again(Checkpoint state, Renderer& renderer) {
  World world = world_of(state);
  fill_fields(world);
  const Scene& scene = world.scene;
  SurfaceMaker surface;
  const Frame frame = make_shown_frame(world, scene.look, make_geometry(scene), surface);
  ViewSettings view;
  view.camera = scene.camera;
  view.look = scene.look;
  if (!view.look.range) view.look.range = colour_range(state);
  return renderer.draw(frame, view);
}

// Why no picture that is drawn here could be held to GOLDEN's; empty where one could.
std::string other_renderer(const GraphicsInfo& here, const RunRecord& golden) {
  const std::string renderer = golden.text({"program", "renderer"}), opengl = golden.text({"program", "opengl"});
  if (renderer == here.renderer && opengl == here.version) return "";
  return "it was drawn by " + renderer + ", OpenGL " + opengl + ", and here draws " + here.renderer + ", OpenGL " +
         here.version;
}

std::vector<PictureRow> redraw(const std::vector<StoredState>& states, const RunRecord& golden, Renderer& renderer,
                               const PictureTolerance& tight) {
  std::vector<PictureRow> rows;
  for (const StoredState& state : states) {
    const Image picture = read_png(golden.folder / "frames" / state.frame);
    Image drawn = draw_again(read_checkpoint(checkpoint_file(golden, state.checkpoint).string()), renderer);
    const PictureDifference difference = picture_difference(picture, drawn, tight.channel);
    rows.push_back({state.frame, difference, tight.accepts(difference), state.checkpoint, std::move(drawn)});
  }
  return rows;
}

}  // namespace

Redrawn redraw_stored_states(const RunRecord& golden, const PictureTolerance& tight) {
  if (golden.frames.empty()) return {};
  const std::vector<StoredState> states = spread_out(stored_states(golden));
  if (states.empty()) return {{}, "", no_state};
  const Image first = read_png(golden.folder / "frames" / states.front().frame);
  std::string reason;
  try {
    const OffscreenContext context;
    reason = other_renderer(context.info(), golden);
    if (reason.empty()) {
      Renderer renderer(first.width, first.height);
      return {redraw(states, golden, renderer, tight), "", ""};
    }
  } catch (const GraphicsError& error) {
    reason = error.what();
  } catch (const InputError& error) {  // all files were read before: a scene that means nothing here, a mesh that moved
    reason = error.what();
  }
  return {{}, "GOLDEN's stored states are not drawn again: " + reason, ""};
}

}  // namespace curlew
