// `curlew bench stability`: where the simulation breaks, along lines and over planes of parameters. Each run has one
// thread and as many go at once as there are cores; what is in the folder's table is not run again.
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <thread>

#include "app/bench.h"
#include "app/interrupt.h"
#include "app/methods.h"
#include "app/progress.h"
#include "app/stability_report.h"
#include "sim/core/error.h"
#include "sim/io/atomic_file.h"
#include "sim/scene/json.h"
#include "sim/scene/sampling.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;

struct KnownScene {
  const char *name, *particles;
};
constexpr KnownScene known_scenes[] = {{"dam_break_2d", "2k"}, {"dam_break", "5k"}};
constexpr double default_time = 4;  // s

const KnownScene& known_scene(const std::string& name) {
  for (const KnownScene& scene : known_scenes) {
    if (name == scene.name) return scene;
  }
  throw InputError("--scenes is " + in_quotes(name) + ", expected dam_break_2d or dam_break");
}

std::vector<StabilityMap> chosen_maps(const std::vector<std::string>& names) {
  const std::vector<StabilityMap>& all = stability_maps();
  if (names.empty()) return all;
  for (const std::string& name : names) {
    if (std::any_of(all.begin(), all.end(), [&](const StabilityMap& map) { return map.name == name; })) continue;
    std::string expected;
    for (const StabilityMap& map : all) expected += (expected.empty() ? "" : ", ") + map.name;
    throw InputError("the line or plane is " + in_quotes(name) + ", expected one of " + expected);
  }
  std::vector<StabilityMap> chosen;
  for (const StabilityMap& map : all) {
    if (std::find(names.begin(), names.end(), map.name) != names.end()) chosen.push_back(map);
  }
  return chosen;
}

StabilityPlan make_stability_plan(const BenchOptions& options) {
  check_free(options.settings, {"micropolar.eta", "energy.guard", "viscosity.nu", "time.cfl", "time.max_step",
                                "time.acceleration_factor", "time.viscosity_factor", "time.fixed_step"});
  StabilityPlan plan{{}, chosen_maps(options.names)};
  std::vector<std::string> names = options.scenes;
  if (names.empty()) names = {"dam_break_2d", "dam_break"};
  for (const std::string& name : names) {
    const std::string particles = single_case(options, known_scene(name).particles);
    StabilityScene scene{name, "", bench_scene(name, 0, particles, options), {}};
    scene.label = scene.scene.dimension == 2 ? "2D" : "3D";
    scene.particles[1] = 0;
    for (const StabilityMap& map : plan.maps) {
      if (map.name != "resolution") continue;
      for (const double resolution : map.xs) scene.particles[resolution] = 0;
    }
    for (auto& [resolution, number] : scene.particles) {
      number = static_cast<std::size_t>(count_particles(at_point(scene.scene, plain_point(resolution))));
    }
    plan.scenes.push_back(scene);
  }
  return plan;
}

// What all cells of a folder share: a run under other settings must not pass for one of these.
void claim_folder(const std::string& folder, double end, const BenchOptions& options) {
  std::string text = number_text(end) + " s";
  for (const std::string& setting : options.settings) text += ", " + setting;
  const std::string file = folder + "/settings.txt";
  if (std::error_code ignored; !fs::exists(file, ignored)) {
    AtomicFile out(file);
    out.write(text + "\n");
    return out.commit();
  }
  std::ifstream in(file, std::ios::binary);
  std::string found;
  std::getline(in, found);
  if (found != text) {
    throw InputError(file + " says that the cells beside it are of " + found + ", expected " + text +
                     "; choose another --out");
  }
}

struct Job {
  const StabilityScene* scene;
  StabilityPoint point;
  double cost;                // s, about
  std::uint64_t most_sweeps;  // 0: no limit
};

// Runs that are missing, each once; of these the plain ones alone where some of them are missing.
std::vector<Job> missing_runs(const StabilityPlan& plan, const StabilityRuns& runs) {
  std::map<StabilityKey, Job> plain, others;
  for (const StabilityScene& scene : plan.scenes) {
    for (const auto& [resolution, particles] : scene.particles) {
      const StabilityKey key = stability_key(scene, plain_point(resolution));
      if (!runs.contains(key)) plain.insert({key, {&scene, key.point, static_cast<double>(particles), 0}});
    }
  }
  if (plain.empty()) {
    for (const StabilityScene& scene : plan.scenes) {
      for (const StabilityMap& map : plan.maps) {
        for (const double y : map.ys) {
          for (const double x : map.xs) {
            for (const bool guard : {false, true}) {
              const StabilityKey key = stability_key(scene, map.at(x, y, guard));
              const StabilityRun& reference = runs.at(stability_key(scene, plain_point(key.point.resolution)));
              const auto most = static_cast<std::uint64_t>(most_work_ratio * static_cast<double>(reference.sweeps));
              if (!runs.contains(key)) others.insert({key, {&scene, key.point, 0.01 + reference.wall, most}});
            }
          }
        }
      }
    }
  }
  std::vector<Job> jobs;
  for (const auto& [key, job] : plain.empty() ? others : plain) jobs.push_back(job);
  return jobs;
}

// Works off jobs on several threads; everything that they share is behind one lock.
class Workers {
 public:
  Workers(const StabilityPlan& plan, StabilityRuns& runs, std::vector<Job> jobs, double end, std::string file)
      : plan_(plan), runs_(runs), jobs_(std::move(jobs)), end_(end), file_(std::move(file)), reached_(jobs_.size()) {
    for (const Job& job : jobs_) total_ += job.cost;
  }

  // False where Ctrl-C ended it.
  bool run(int threads) {
    std::vector<std::thread> all;
    for (int k = 0; k < threads; ++k) all.emplace_back([this] { work(); });
    for (std::thread& thread : all) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    return !interrupted();
  }

 private:
  void work() {
    omp_set_num_threads(1);  // of this thread's own loops
    for (std::size_t k; !stopped() && (k = next_++) < jobs_.size();) {
      try {
        run_job(k);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        failed_ = true;
      }
    }
  }

  bool stopped() const { return interrupted() || failed_; }

  void run_job(std::size_t k) {
    const Job& job = jobs_[k];
    const auto go_on = [&](double time) {
      show(k, std::min(1.0, time / end_));
      return !stopped();
    };
    const auto run = run_stability(at_point(job.scene->scene, job.point), end_, job.most_sweeps, go_on);
    if (!run) return;
    const std::lock_guard lock(mutex_);
    if (job.most_sweeps == 0 && !run->pass.empty()) {
      throw InputError("plain DFSPH diverged in " + job.scene->name + " at " + number_text(run->end) + " s in pass " +
                       run->pass + ", so the cells have nothing to be compared with; leave out what --set changes");
    }
    runs_[stability_key(*job.scene, job.point)] = *run;
    write_stability(file_, plan_, runs_);
    ++finished_;
  }

  void show(std::size_t k, double share) {
    const std::lock_guard lock(mutex_);
    done_ += jobs_[k].cost * (share - reached_[k]);
    reached_[k] = share;
    progress_.show(std::min(1.0, done_ / total_), std::to_string(finished_) + " of " + std::to_string(jobs_.size()) +
                                                      (jobs_[k].most_sweeps == 0 ? " plain runs" : " runs"));
  }

  const StabilityPlan& plan_;
  StabilityRuns& runs_;
  const std::vector<Job> jobs_;
  const double end_;
  const std::string file_;
  std::vector<double> reached_;  // share of each job
  double total_ = 0, done_ = 0;  // of the costs
  std::size_t finished_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::exception_ptr failure_;
  std::mutex mutex_;
  Progress progress_{false};
};

void report(const StabilityPlan& plan, const StabilityRuns& runs, const std::string& folder, double end,
            const std::string& command) {
  std::string about = "Dam break";
  for (const StabilityScene& scene : plan.scenes) {
    about += std::string(&scene == &plan.scenes.front() ? ", " : " and ") + scene.label + " with " +
             std::to_string(scene.particles.at(1)) + " particles";
  }
  about += ", " + number_text(end) + " s";
  const std::string summary = stability_summary(plan, runs, about + " (`" + command + "`)");
  AtomicFile out(folder + "/summary.md");
  out.write(summary);
  out.commit();
  std::printf("%s\n%s/cells.csv\n", summary.c_str(), folder.c_str());
  for (const auto& [name, picture] : stability_pictures(plan, runs, about, command)) {
    write_svg(folder + "/" + name, picture);
    std::printf("%s/%s\n", folder.c_str(), name.c_str());
  }
}

}  // namespace

int bench_stability(const BenchOptions& options) {
  const std::string folder = options.out.empty() ? "out/stability" : options.out, file = folder + "/cells.csv";
  const double end = options.time.value_or(default_time);
  const StabilityPlan plan = make_stability_plan(options);
  claim_folder(folder, end, options);
  StabilityRuns runs = read_stability(file);
  watch_for_interrupt();
  const int threads = omp_get_max_threads();
  for (std::vector<Job> jobs; !(jobs = missing_runs(plan, runs)).empty();) {
    if (!Workers(plan, runs, jobs, end, file).run(threads)) {
      std::printf("interrupted; the same command goes on with the runs that were in hand\n");
      return 130;
    }
  }
  write_stability(file, plan, runs);
  report(plan, runs, folder, end, options.command);
  return 0;
}

}  // namespace curlew
