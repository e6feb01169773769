// A run on a thread of its own, for a window: it is told what to do and asked what there is to see, and nobody waits
// for a step. Knows no OpenGL and no widgets.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/frame.h"
#include "sim/core/passes.h"
#include "sim/core/world.h"
#include "sim/measure/energy_budget.h"
#include "sim/surface/surface.h"

namespace curlew {

// A curve's value, by a name that is a string literal.
struct NamedValue {
  std::string_view name;
  double value = 0;
};

// What one step was like, for plots.
struct Sample {
  std::int64_t step = 0;
  double time = 0, dt = 0;                            // s
  double kinetic = 0, rotational = 0, potential = 0;  // J
  double compression = 0, compression_target = 0;     // fractions: true mean at the new positions; after the solve
  double divergence_error = 0;                        // fraction
  int pressure_iterations = 0, divergence_iterations = 0;
  double ms_step = 0;              // wall time
  std::vector<float> ms_pass;      // of each pass of pass_table(); 0 where it did not run
  std::vector<NamedValue> budget;  // J since the start: work by each model, losses by cause
};

enum class RunState { empty, paused, playing, diverged };

struct SessionStatus {
  RunState state = RunState::empty;
  std::int64_t scene_number = 0;  // grows with every scene that was laid out
  bool loading = false;
  double loading_seconds = 0;
  std::string loading_what;
  std::size_t particles = 0;
  double particle_radius = 0;  // m
  std::int64_t step = 0;
  double time = 0, dt = 0;       // s
  double real_time_factor = 0;   // simulated seconds a second, over the last second
  double steps_a_second = 0;     // the same
  std::size_t solver_bytes = 0;  // memory that the solver holds
  bool recording = false;
};

// One sentence for the user.
struct Message {
  std::string text;
  bool error = false;
};

class Session {
 public:
  // threads: for the solver; 0 takes all cores.
  explicit Session(int threads = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Lays out a scene, paused. The run that is there stays until the new one stands, and for good where that fails, or
  // where cancel() or another open() comes first. Where a number of particles is given, the spacing that comes nearest
  // replaces the scene's.
  void open(Scene scene, std::uint64_t seed = 0, std::optional<double> particles = {});
  void cancel();

  void play(bool on);
  void step_once();

  // Live parameters count from the next step; the others stay as the scene was laid out.
  void set_parameters(const Parameters& parameters);
  void colour_by(const std::string& field);
  // With water, frames bring the mesh of its surface.
  void show_as(LookStyle style);
  void save_checkpoint(const std::string& file);

  // While this is on, a frame is kept for every 1/fps s of simulated time, and the solver waits for its taker.
  void record(double fps);  // 0 ends it

  struct Update {
    SessionStatus status;
    std::shared_ptr<const Frame> frame;  // the newest, or null where it was taken already
    std::vector<Sample> samples;         // of the steps since the last update
    std::vector<std::shared_ptr<const Frame>> recorded;
    std::vector<Message> messages;  // errors and news, each one sentence
    Parameters parameters;          // that the solver reads
  };
  // Takes what is new. Never waits for a step.
  Update poll();

  // Waits until everything that was asked for so far is done.
  void finish_tasks();
  // Of the state after the step in hand.
  std::string state_hash();

 private:
  void post(std::function<void()> task);
  void work();
  void lay_out(Scene scene, std::uint64_t seed, std::optional<double> particles, std::int64_t number);
  void adopt(World world, Plan plan, std::int64_t number);
  void plan();
  void advance();
  FieldSet frame_demand() const;
  std::shared_ptr<const Frame> take_frame();
  void publish();
  void keep_recorded_frames();
  void say(std::string message, bool error);

  // Touched by the solver's thread alone.
  World world_;
  Plan plan_;
  std::vector<const Pass*> for_frames_;  // passes that only a frame needs
  std::string colour_ = "speed";
  LookStyle style_ = LookStyle::particles;
  SurfaceMaker surface_;
  std::shared_ptr<const FrameGeometry> geometry_;
  double recording_fps_ = 0;
  std::int64_t next_recorded_ = 0;
  std::vector<float> ms_pass_;
  EnergyBudget budget_{Plan{}};
  std::vector<NamedValue> spent_;               // J since the start; what a model did stays when it is switched off
  std::deque<std::pair<double, double>> pace_;  // wall time, simulated time
  int threads_ = 0;

  // Behind the mutex.
  std::mutex mutex_;
  std::condition_variable wake_, room_;
  std::deque<std::function<void()>> tasks_;
  bool closing_ = false, playing_ = false, loaded_ = false, diverged_ = false;
  std::int64_t newest_ = 0;  // layout that was asked for; older ones are dropped
  bool frame_taken_ = true;
  double loading_since_ = 0;
  SessionStatus status_;
  std::shared_ptr<const Frame> frame_;
  std::vector<Sample> samples_;
  std::vector<std::shared_ptr<const Frame>> recorded_;
  std::vector<Message> messages_;
  Parameters parameters_;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace curlew
