// `curlew run`: the one run loop.
#include <omp.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/probes.h"
#include "app/progress.h"
#include "app/run_json.h"
#include "app/saving.h"
#include "app/setup.h"
#include "app/stats.h"
#include "sim/core/error.h"
#include "sim/io/checkpoint.h"
#include "sim/io/run_folder.h"
#include "sim/measure/probes.h"
#include "sim/measure/state_hash.h"
#include "sim/scene/json.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

// A run as it starts: new, or from a checkpoint.
struct Start {
  World world;
  std::optional<std::int64_t> resumed_step;
  std::optional<std::array<double, 2>> colour_range;
};

// The folder of the run that a checkpoint belongs to, where it lies in RUN/checkpoints/; else empty.
std::string run_of(const std::filesystem::path& checkpoint) {
  const bool bare = !checkpoint.has_parent_path();
  const std::filesystem::path holder = bare ? std::filesystem::current_path() : checkpoint.parent_path();
  if (holder.filename() != "checkpoints") return "";
  return holder.has_parent_path() ? holder.parent_path().string() : ".";
}

// What the checkpoint holds may be said again, but not otherwise.
void check_same(const RunOptions& options, const Checkpoint& checkpoint) {
  using std::filesystem::path;
  if (!options.scene.empty() && path(options.scene).stem() != path(checkpoint.scene_file).stem()) {
    throw InputError("--resume goes on with the scene of the checkpoint, " + checkpoint.scene_file + "; leave out " +
                     options.scene);
  }
  if (options.seed != 0 && options.seed != checkpoint.seed) {
    throw InputError("--resume keeps the seed of the checkpoint, which is " + std::to_string(checkpoint.seed) +
                     "; leave out --seed");
  }
}

Start resume(const RunOptions& options) {
  if (options.radius || options.particles) {
    throw InputError("--resume keeps the particles of the checkpoint; leave out --radius and --particles");
  }
  Checkpoint checkpoint = read_checkpoint(options.resume);
  check_same(options, checkpoint);
  Scene scene = parse_scene(checkpoint.scene_json, checkpoint.scene_file);
  apply_settings(scene.parameters, options.settings);
  if (options.look) scene.look.style = *options.look;  // pictures only
  check_resolution(scene);
  Start start{make_empty_world(scene, checkpoint.seed), checkpoint.step, {}};
  World& w = start.world;
  w.fields = std::move(checkpoint.fields);
  w.count = w.fields.id.size();
  w.step = checkpoint.step;
  w.time = checkpoint.time;
  w.dt = checkpoint.dt;
  double low = std::nan(""), high = std::nan("");
  for (const auto& [name, value] : checkpoint.numbers) {
    if (name == "colour_low") low = value;
    if (name == "colour_high") high = value;
    if (name == "energy_reserve") w.energy.reserve = value;
    if (name == "wavelet_moved") w.wavelet.moved = value;
    if (name == "start_speed") w.start.speed = value;
    if (name == "start_energy") w.start.energy = value, w.start.known = true;
  }
  if (low < high) start.colour_range = {low, high};
  return start;
}

class Run {
 public:
  Run(const RunOptions& options, Start start)
      : options_(options),
        world_(std::move(start.world)),
        resumed_(start.resumed_step),
        folder_(choose_folder()),
        output_(options, world_.scene, folder_, start.colour_range) {
    plan_ =
        make_plan(world_, StepRecorder::demand(options.full_columns) | output_.demand() | probe_fields(world_.scene));
    prepare(world_, plan_);
    StepRecorder::Settings settings{options.full_columns, options.hash_passes, resumed_};
    recorder_ = std::make_unique<StepRecorder>(folder_, plan_, settings);
    probes_ = std::make_unique<ProbeRecorder>(folder_, world_, resumed_.has_value());
    if (resumed_) remove_later_checkpoints(folder_, *resumed_);  // now that nothing can refuse to go on
    summary_.resumed_from = options.resume;
    summary_.changed_on_resume = resumed_ && !options.settings.empty();
    next_frame_ = resumed_ ? frame_of(world_.time) + 1 : 0;
    next_checkpoint_ = checkpoint_of(world_.time) + 1;
    write_json();
  }

  int go() {
    try {
      return simulate();
    } catch (const DivergedError&) {
      throw;
    } catch (const std::exception& error) {
      note_failure(error.what());
      throw;
    }
  }

 private:
  int simulate() {
    watch_for_interrupt();
    if (!resumed_) {
      recorder_->write_row(world_, finished());
      probes_->write_due(world_);
      write_due_frames();
    }
    Progress progress(options_.quiet);
    while (!finished() && !stopping_) {
      try {
        advance();
      } catch (const DivergedError& error) {
        progress.finish();
        return end_diverged(error);
      }
      progress.show(share(), status_line());
    }
    progress.finish();
    return end();
  }

  std::string choose_folder() const {
    namespace fs = std::filesystem;
    const std::string own = resumed_ ? run_of(options_.resume) : "";
    const std::string folder = !options_.out.empty() ? options_.out
                               : !own.empty()        ? own
                                                     : "out/" + world_.scene.file.stem().string();
    std::error_code ignored;
    if (!own.empty() && fs::equivalent(folder, own, ignored)) {
      remove_unfinished_files(folder);
    } else {
      prepare_run_folder(folder, options_.overwrite);
    }
    return folder;
  }

  // The frame whose time is the last at or before `time`.
  // Counted alike, so that a checkpoint and a frame of the same time are of the same step.
  std::int64_t checkpoint_of(double time) const {
    const double every = options_.checkpoint_every;
    return every > 0 ? static_cast<std::int64_t>(std::floor(time / every + 1e-9)) : 0;
  }
  std::int64_t frame_of(double time) const { return static_cast<std::int64_t>(std::floor(time * options_.fps + 1e-9)); }

  double end_time() const { return options_.time ? *options_.time : options_.steps ? INFINITY : 5.0; }
  bool finished() const {
    return world_.time >= end_time() * (1 - 1e-12) || (options_.steps && world_.step >= *options_.steps) ||
           world_.count == 0;
  }
  double share() const {
    const double by_time = world_.time / end_time();
    const double by_step = options_.steps ? static_cast<double>(world_.step) / static_cast<double>(*options_.steps) : 0;
    return std::min(1.0, std::max(by_time, by_step));
  }

  std::string status_line() const {
    char text[160];
    std::snprintf(text, sizeof text, "t %.3f s, step %lld, dt %.2f ms, %d+%d iterations, %.1f M particle-steps/s",
                  world_.time, static_cast<long long>(world_.step), 1e3 * world_.dt, world_.report.pressure_iterations,
                  world_.report.divergence_iterations, rate());
    return text;
  }
  double rate() const { return step_seconds_ > 0 ? 1e-6 * particle_steps_ / step_seconds_ : 0; }

  void advance() {
    recorder_->begin_step(world_);
    const auto begin = Clock::now();
    step(world_, plan_, recorder_.get());
    const double seconds = seconds_since(begin);
    recorder_->end_step(1e3 * seconds);
    step_seconds_ += seconds;
    particle_steps_ += static_cast<double>(world_.count);
    const bool frame_due = frame_of(world_.time) >= next_frame_;
    stopping_ = interrupted();
    const bool last = finished() || stopping_;
    if (!options_.stats_each_frame || frame_due || last) recorder_->write_row(world_, last);
    probes_->write_due(world_);
    write_due_frames();
    if (checkpoint_of(world_.time) >= next_checkpoint_) {
      output_.settle();  // a resumed run begins with the frame after its checkpoint
      save_checkpoint("");
      next_checkpoint_ = checkpoint_of(world_.time) + 1;
    }
  }

  // The first state at or past a frame's time is that frame; a step longer than a frame's time fills several.
  void write_due_frames() {
    for (; next_frame_ <= frame_of(world_.time); ++next_frame_) {
      output_.write(world_, next_frame_);
      ++summary_.frames;
    }
  }

  std::string save_checkpoint(const std::string& name) {
    char number[32];
    std::snprintf(number, sizeof number, "%06lld", static_cast<long long>(world_.step));
    const std::string file = folder_ + "/checkpoints/" + (name.empty() ? number : name) + ".curlew";
    std::vector<std::pair<std::string, double>> numbers;
    if (const auto range = output_.colour_range()) {
      numbers = {{"colour_low", (*range)[0]}, {"colour_high", (*range)[1]}};
    }
    curlew::save_checkpoint(file, world_, std::move(numbers));
    return file;
  }

  void write_json() {
    summary_.wall_seconds = seconds_since(begin_);
    write_run_json(folder_, options_, world_, summary_, output_.graphics());
  }

  // run.json should not say for ever that the run goes on. It may be the disk that failed: then what is there stays.
  void note_failure(const std::string& what) {
    summary_.status = "failed";
    summary_.message = what;
    try {
      write_json();
    } catch (const std::exception&) {  // the first error is the one to tell
    }
  }

  int end() {
    const bool stopped = stopping_ && !finished();
    output_.settle();
    std::string saved;
    if (stopped) saved = save_checkpoint("");  // before the video ends, which may fail
    output_.finish();
    summary_.status = stopped ? "interrupted" : "done";
    write_json();
    if (!options_.quiet) {
      std::printf("%s: %zu particles, %lld steps, %.3f s simulated in %s, %.2f M particle-steps a second, state %s\n",
                  folder_.c_str(), world_.count, static_cast<long long>(world_.step), world_.time,
                  duration_text(summary_.wall_seconds).c_str(), rate(), hash_text(state_hash(world_.fields)).c_str());
      if (summary_.frames > 0 && output_.wants_frames())
        std::printf("%lld frames\n", static_cast<long long>(summary_.frames));
      if (stopped) std::printf("interrupted; go on with: curlew run --resume %s\n", saved.c_str());
    }
    return stopped ? 130 : 0;
  }

  // The step put the world back to the state before it: that is saved, for a look or another try.
  int end_diverged(const DivergedError& error) {
    const std::string saved = save_checkpoint("diverged");
    recorder_->end_early(world_);
    output_.finish();
    summary_.status = "diverged";
    summary_.message = error.what();
    write_json();
    throw DivergedError(std::string(error.what()) + "; the state before that step is in " + saved, error.pass,
                        error.particle);
  }

  const RunOptions& options_;
  Clock::time_point begin_ = Clock::now();
  World world_;
  std::optional<std::int64_t> resumed_;
  std::string folder_;
  FrameOutput output_;
  Plan plan_;
  std::unique_ptr<StepRecorder> recorder_;
  std::unique_ptr<ProbeRecorder> probes_;
  RunSummary summary_;
  std::int64_t next_frame_ = 0;
  std::int64_t next_checkpoint_ = 1;
  double step_seconds_ = 0, particle_steps_ = 0;
  bool stopping_ = false;  // Ctrl-C was seen after the last step
};

}  // namespace

int run_command(const RunOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  if (options.resume.empty()) {
    const Scene scene = scene_from(options);
    return Run(options, {make_world(scene, options.seed), {}, {}}).go();
  }
  return Run(options, resume(options)).go();
}

}  // namespace curlew
