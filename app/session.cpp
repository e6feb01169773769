#include "app/session.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <new>
#include <optional>

#include "app/saving.h"
#include "sim/core/error.h"
#include "sim/core/watch.h"
#include "sim/measure/diagnostics.h"
#include "sim/measure/state_hash.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

struct PassTimes : PassObserver {
  PassTimes(std::vector<float>& ms, EnergyBudget& spent) : ms_pass(ms), budget(spent) {
    ms_pass.assign(pass_table().size(), 0);
  }
  void after(const Pass& pass, const World& world, double milliseconds) override {
    budget.after(pass, world);
    ms_pass[static_cast<std::size_t>(&pass - pass_table().data())] = static_cast<float>(milliseconds);
  }
  std::vector<float>& ms_pass;
  EnergyBudget& budget;
};

// Gravity's work is seen as potential energy, beside which the others would be flat lines.
void add_terms(std::vector<NamedValue>& spent, const EnergyBudget& budget) {
  for (const EnergyBudget::Term& term : budget.terms()) {
    if (term.name == "work_gravity") continue;
    auto entry = std::find_if(spent.begin(), spent.end(), [&](const NamedValue& v) { return v.name == term.name; });
    if (entry == spent.end()) entry = spent.insert(entry, {term.name, 0});
    entry->value += term.step;
  }
}

// Nobody looks at a session for hours and still wants all samples: beyond this the oldest half is dropped.
constexpr std::size_t most_samples = 200000;
// The solver waits while so many recorded frames are not yet taken.
constexpr std::size_t most_recorded = 3;

}  // namespace

Session::Session(int threads) : threads_(threads) {
  thread_ = std::thread([this] { work(); });
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  room_.notify_all();
  thread_.join();
}

void Session::post(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  wake_.notify_all();
}

void Session::open(Scene scene, std::uint64_t seed, std::optional<double> particles) {
  std::int64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++newest_;
    status_.loading = true;
    status_.loading_what = scene.name;
    loading_since_ = now();
  }
  post([this, scene = std::move(scene), seed, particles, number] { lay_out(scene, seed, particles, number); });
}

void Session::cancel() {
  const std::lock_guard lock(mutex_);
  if (!status_.loading) return;
  ++newest_;
  status_.loading = false;
  messages_.push_back({"Cancelled", false});
}

void Session::play(bool on) {
  {
    const std::lock_guard lock(mutex_);
    playing_ = on && loaded_;
    if (playing_ && diverged_) tasks_.emplace_back([this] { forgive(world_); });
    if (on) diverged_ = false;
  }
  wake_.notify_all();
}

void Session::step_once() {
  post([this] {
    {
      const std::lock_guard lock(mutex_);
      if (!loaded_ || playing_) return;
      diverged_ = false;
    }
    advance();
  });
}

void Session::set_parameters(const Parameters& parameters) {
  post([this, parameters] {
    {
      const std::lock_guard lock(mutex_);
      if (!loaded_) return;
    }
    const std::string_view missing = colour_switch(colour_, world_.scene.parameters);
    for (const ParameterRow& row : parameter_table()) {
      if (row.live) row.set(world_.scene.parameters, row.get(parameters));
    }
    plan();
    // The colours of a model that was switched on or off are other ones at once, also where nothing runs.
    if (colour_switch(colour_, world_.scene.parameters) != missing || style_ == LookStyle::water) publish();
    const std::lock_guard lock(mutex_);
    parameters_ = world_.scene.parameters;
  });
}

void Session::colour_by(const std::string& field) {
  post([this, field] {
    colour_ = field;
    {
      const std::lock_guard lock(mutex_);
      if (!loaded_) return;
    }
    plan();
    publish();
  });
}

void Session::show_as(LookStyle style) {
  post([this, style] {
    style_ = style;
    {
      const std::lock_guard lock(mutex_);
      if (!loaded_) return;
    }
    plan();
    publish();
  });
}

void Session::save_checkpoint(const std::string& file) {
  post([this, file] {
    {
      const std::lock_guard lock(mutex_);
      if (!loaded_) return;
    }
    curlew::save_checkpoint(file, world_);
    say("Saved " + file + "; go on with: curlew run --resume " + file, false);
  });
}

void Session::record(double fps) {
  post([this, fps] {
    recording_fps_ = fps;
    next_recorded_ = fps > 0 ? static_cast<std::int64_t>(std::floor(world_.time * fps * (1 + 1e-12))) + 1 : 0;
    const std::lock_guard lock(mutex_);
    status_.recording = fps > 0;
  });
  room_.notify_all();
}

Session::Update Session::poll() {
  Update update;
  {
    const std::lock_guard lock(mutex_);
    status_.state = !loaded_    ? RunState::empty
                    : diverged_ ? RunState::diverged
                    : playing_  ? RunState::playing
                                : RunState::paused;
    status_.loading_seconds = status_.loading ? now() - loading_since_ : 0;
    update.status = status_;
    update.frame = std::move(frame_);
    frame_ = nullptr;
    if (update.frame) frame_taken_ = true;
    std::swap(update.samples, samples_);
    std::swap(update.recorded, recorded_);
    std::swap(update.messages, messages_);
    update.parameters = parameters_;
  }
  room_.notify_all();
  return update;
}

void Session::finish_tasks() {
  std::promise<void> done;
  post([&] { done.set_value(); });
  done.get_future().wait();
}

std::string Session::state_hash() {
  std::promise<std::string> text;
  post([&] { text.set_value(hash_text(curlew::state_hash(world_.fields))); });
  return text.get_future().get();
}

void Session::say(std::string message, bool error) {
  const std::lock_guard lock(mutex_);
  messages_.push_back({std::move(message), error});
}

void Session::work() {
  if (threads_ > 0) omp_set_num_threads(threads_);
  for (;;) {
    std::function<void()> task;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return closing_ || !tasks_.empty() || playing_; });
      if (closing_) return;
      if (!tasks_.empty()) {
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
    }
    try {
      if (task) {
        task();
      } else {
        advance();
      }
    } catch (const std::bad_alloc&) {
      play(false);
      say("Memory ran out; choose fewer particles", true);
    } catch (const std::exception& error) {  // bad input, a full disk: the run that is there stays
      if (!task) play(false);
      say(error.what(), true);
    }
  }
}

void Session::lay_out(Scene scene, std::uint64_t seed, std::optional<double> particles, std::int64_t number) {
  const auto newest = [&] {
    const std::lock_guard lock(mutex_);
    return number == newest_;
  };
  if (!newest()) return;
  std::string failure;
  try {
    if (particles) scene = with_particles(scene, *particles);
    if (!newest()) return;
    World world = make_world(scene, seed);
    if (!newest()) return;
    Plan plan = make_plan(world);
    prepare(world, plan);
    return adopt(std::move(world), std::move(plan), number);
  } catch (const std::bad_alloc&) {
    failure = scene.name + " does not fit into memory; choose fewer particles";
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const std::lock_guard lock(mutex_);
  if (number != newest_) return;
  status_.loading = false;
  messages_.push_back({failure, true});
}

void Session::adopt(World world, Plan plan, std::int64_t number) {
  {
    const std::lock_guard lock(mutex_);
    if (number != newest_) return;
    playing_ = diverged_ = false;
    loaded_ = true;
    status_.loading = false;
    ++status_.scene_number;
    samples_.clear();
    recorded_.clear();
    parameters_ = world.scene.parameters;
    status_.particle_radius = world.scene.particle_radius;
    status_.particles = world.count;
    status_.step = world.step;
    status_.time = world.time;
    status_.dt = world.dt;
    frame_ = nullptr;  // it shows the run before
    frame_taken_ = true;
  }
  world_ = std::move(world);
  plan_ = std::move(plan);
  geometry_ = make_geometry(world_.scene);
  pace_.clear();
  next_recorded_ = 0;
  budget_ = EnergyBudget(plan_);
  spent_.clear();
  this->plan();
  publish();
}

// The steps run the plan that needs no picture; what only the picture needs runs when one is taken.
void Session::plan() {
  const Plan bare = make_plan(world_), full = make_plan(world_, frame_demand());
  // What a field that is new holds, somebody has to find out first.
  const bool changed = bare.step != plan_.step || !(full.fields.without(plan_.fields) == FieldSet());
  if (changed) budget_ = EnergyBudget(bare);
  plan_ = bare;
  plan_.fields = full.fields;
  for_frames_.clear();
  for (const Pass* pass : full.step) {
    if (std::find(bare.step.begin(), bare.step.end(), pass) == bare.step.end()) for_frames_.push_back(pass);
  }
  if (changed) {
    prepare(world_, plan_);  // a pass that was off before has left nothing for the next step
  } else {
    allocate(world_, plan_);
  }
  const std::lock_guard lock(mutex_);
  status_.solver_bytes = allocated_bytes(world_);
}

void Session::advance() {
  PassTimes times(ms_pass_, budget_);
  const double begin = now();
  budget_.begin_step(world_);
  try {
    step(world_, plan_, &times);
  } catch (const DivergedError& error) {
    publish();
    const std::lock_guard lock(mutex_);
    playing_ = false;
    diverged_ = true;
    messages_.push_back({error.what(), true});
    return;
  }
  const double end = now();
  add_terms(spent_, budget_);
  const Diagnostics d = diagnose(world_);
  const StepReport& r = world_.report;
  pace_.emplace_back(end, world_.time);
  while (pace_.size() > 2 && pace_.front().first < end - 1) pace_.pop_front();
  const double wall = pace_.back().first - pace_.front().first;
  bool wanted = false;
  {
    const std::lock_guard lock(mutex_);
    if (samples_.size() >= most_samples) samples_.erase(samples_.begin(), samples_.begin() + most_samples / 2);
    samples_.push_back({world_.step, world_.time, world_.dt, d.kinetic, d.rotational, d.potential,
                        r.density_error_true_avg, r.density_error_avg, r.divergence_error, r.pressure_iterations,
                        r.divergence_iterations, 1e3 * (end - begin), ms_pass_, spent_});
    if (wall > 0) {
      status_.real_time_factor = (pace_.back().second - pace_.front().second) / wall;
      status_.steps_a_second = static_cast<double>(pace_.size() - 1) / wall;
    }
    wanted = frame_taken_ || !playing_;
  }
  keep_recorded_frames();
  if (wanted) publish();
}

FieldSet Session::frame_demand() const {
  return style_ == LookStyle::water ? colour_demand(colour_) | surface_demand() : colour_demand(colour_);
}

std::shared_ptr<const Frame> Session::take_frame() {
  for (const Pass* pass : for_frames_) pass->run(world_);
  const bool clear = style_ != LookStyle::particles && world_.scene.dimension == 3;
  auto frame = std::make_shared<Frame>(make_frame(world_, clear ? "none" : colour_, geometry_));
  if (clear && style_ == LookStyle::water) frame->surface = make_surface(world_, surface_);
  return frame;
}

void Session::publish() {
  auto frame = take_frame();
  const std::lock_guard lock(mutex_);
  frame_ = std::move(frame);
  frame_taken_ = false;
  status_.particles = world_.count;
  status_.step = world_.step;
  status_.time = world_.time;
  status_.dt = world_.dt;
}

void Session::keep_recorded_frames() {
  if (recording_fps_ <= 0) return;
  const auto due = static_cast<std::int64_t>(std::floor(world_.time * recording_fps_ * (1 + 1e-12)));
  if (due < next_recorded_) return;
  const auto frame = take_frame();
  for (; next_recorded_ <= due; ++next_recorded_) {
    std::unique_lock lock(mutex_);
    // What was asked for meanwhile, such as an end of the recording, must not wait for the taker.
    room_.wait(lock, [&] { return closing_ || !tasks_.empty() || recorded_.size() < most_recorded; });
    recorded_.push_back(frame);
  }
}

}  // namespace curlew
