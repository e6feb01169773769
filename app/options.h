// What a command line asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/scene/scene.h"

namespace curlew {

struct RunOptions {
  std::string scene;                  // file or bundled name; empty with --resume
  std::vector<std::string> settings;  // key=value
  std::optional<double> radius, particles;
  std::optional<double> time;  // s
  std::optional<std::int64_t> steps;
  double fps = 60;
  int threads = 0;  // 0: all cores (the user cannot give 0)
  std::uint64_t seed = 0;
  std::string out;  // empty: out/NAME, accuracy: none
  bool stats_each_frame = false, full_columns = false;
  bool frames = false;
  std::optional<LookStyle> look;  // instead of the scene's
  int width = 1280, height = 720;
  std::string video;
  std::string particles_out;    // vtk, ply, bgeo or empty
  bool sub_particles = false;   // in particles_out, in place of particles that have split
  std::string mesh_out;         // ply, obj or empty
  double checkpoint_every = 0;  // s of simulated time, 0: none
  std::string resume;
  bool quiet = false, overwrite = false;
  std::int64_t hash_passes = 0;  // every so many steps, 0: never
  std::string command;           // the whole line, for run.json
};

// `curlew mesh` and `curlew render`: frames of a finished run made again from its particle files.
struct RedoOptions {
  std::string folder;                 // of the run
  std::vector<std::string> settings;  // key=value of the surface
  std::string mesh_out = "ply";       // mesh
  std::string view;                   // render: scene whose camera and look to use, or empty for the run's own
  std::optional<LookStyle> look;      // render
  int width = 1280, height = 720;     // render
  std::string video;                  // render
  double fps = 60;                    // of the video
  int threads = 0;
  bool quiet = false, overwrite = false;
};

// `curlew compare GOLDEN NEW`.
struct CompareOptions {
  std::string golden, now;  // folders of runs
  std::string report;       // page; empty: NEW/compare.html
  bool accept = false, quiet = false;
};

struct BenchOptions {
  std::string name;
  std::vector<std::string> names;                // cases of accuracy
  std::vector<std::string> cases;                // particle numbers
  std::vector<std::string> settings;             // key=value
  std::vector<std::string> scenes, methods, nu;  // empty: the benchmark's own
  std::vector<std::string> rows;                 // names of settings that accuracy compares; empty: all
  std::optional<double> time;                    // s
  std::string out;                               // empty: out/NAME, accuracy: none
  int threads = 0;
  double time_share = 1;           // of each case's time, for a quick look
  std::optional<double> at_least;  // millions of particle-steps a second: a gate
  std::string command;             // the whole line, for what is written
};

}  // namespace curlew
