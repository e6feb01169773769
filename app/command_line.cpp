#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "app/bench.h"
#include "app/commands.h"
#include "app/numbers.h"
#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/scene/json.h"
#include "sim/scene/names.h"

namespace curlew {
namespace {

constexpr double no_limit = std::numeric_limits<double>::max();
constexpr double most_frames_a_second = 1e6;
constexpr std::int64_t most_threads = 1024;  // far more than any machine has, and still few enough to be started
constexpr std::int64_t most_steps = 1000000000000;
constexpr std::int64_t most_seed = 9007199254740991;  // run.json holds doubles, which count to 2^53

double parse_positive(const std::string& option, const std::string& text, const std::string& unit,
                      double most = no_limit) {
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [end, status] = std::from_chars(text.data(), last, value);
  if (status != std::errc() || end != last || !std::isfinite(value) || value <= 0 || value > most) {
    throw InputError(option + " is " + in_quotes(text) + ", expected a positive number" +
                     (unit.empty() ? "" : " of " + unit) + (most < no_limit ? ", at most " + plain_number(most) : ""));
  }
  return value;
}

std::int64_t parse_count(const std::string& option, const std::string& text, std::int64_t least, std::int64_t most) {
  std::int64_t value = 0;
  const char* last = text.data() + text.size();
  const auto [end, status] = std::from_chars(text.data(), last, value);
  if (status != std::errc() || end != last || value < least || value > most) {
    throw InputError(option + " is " + in_quotes(text) + ", expected a whole number from " + std::to_string(least) +
                     " to " + std::to_string(most));
  }
  return value;
}

// The range that a scene file has too.
double parse_radius(const std::string& text) {
  const double radius = parse_positive("--radius", text, "metres", 1000);
  if (radius < 1e-9) throw InputError("--radius is " + in_quotes(text) + ", expected at least 1e-9 metres");
  return radius;
}

int parse_threads(const std::string& text) { return static_cast<int>(parse_count("--threads", text, 1, most_threads)); }

void parse_size(const std::string& text, int& width, int& height) {
  const auto cross = text.find('x');
  int* numbers[] = {&width, &height};
  const std::string parts[] = {text.substr(0, cross), cross == std::string::npos ? "" : text.substr(cross + 1)};
  for (int k = 0; k < 2; ++k) {
    const char* last = parts[k].data() + parts[k].size();
    const auto [end, status] = std::from_chars(parts[k].data(), last, *numbers[k]);
    if (parts[k].empty() || status != std::errc() || end != last || *numbers[k] < 16 || *numbers[k] > 8192) {
      throw InputError("--size is " + in_quotes(text) +
                       ", expected WIDTHxHEIGHT such as 1280x720, each from 16 to 8192");
    }
  }
}

// One of a few words.
std::string parse_word(const std::string& option, const std::string& text, const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) {
    if (word == text) return text;
    all += (all.empty() ? "" : word == words.back() ? " or " : ", ") + word;
  }
  throw InputError(option + " is " + in_quotes(text) + ", expected " + all);
}

void add_path(CLI::App& app, const std::string& name, std::string& target, const std::string& help) {
  const auto take = [&target, name](const std::string& text) {
    if (text.empty()) throw InputError(name + " is empty, expected a path");
    target = text;
  };
  app.add_option_function<std::string>(name, take, help);
}

void add_look(CLI::App& app, std::optional<LookStyle>& target) {
  const auto take = [&target](const std::string& t) {
    const auto names = look_style_names();
    const std::string name = parse_word("--look", t, {names.begin(), names.end()});
    target = static_cast<LookStyle>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  app.add_option_function<std::string>("--look", take,
                                       "How water is shown: particles, water or fast-water (as the scene says)");
}

// Options are read as text and checked here, so that every message is ours.
void add_common_options(CLI::App& app, RunOptions& o) {
  app.add_option("SCENE", o.scene, "Scene file, or the name of a bundled scene (curlew scenes)");
  app.add_option("--set", o.settings, "key=value: any parameter (curlew params), repeatable")->allow_extra_args(false);
  const auto radius = [&](const std::string& t) { o.radius = parse_radius(t); };
  app.add_option_function<std::string>("--radius", radius, "Particle radius in m");
  const auto particles = [&](const std::string& t) { o.particles = parse_particle_number("--particles", t); };
  app.add_option_function<std::string>("--particles", particles, "Resolution that comes nearest: 24k, 1.2M, 1e5");
  add_look(app, o.look);
}

void add_threads_and_seed(CLI::App& app, RunOptions& o) {
  app.add_option_function<std::string>(
      "--threads", [&](const std::string& t) { o.threads = parse_threads(t); }, "Threads (all cores)");
  const auto seed = [&](const std::string& t) {
    o.seed = static_cast<std::uint64_t>(parse_count("--seed", t, 0, most_seed));
  };
  app.add_option_function<std::string>("--seed", seed, "Seed of all random numbers (0)");
}

void add_run_options(CLI::App& app, RunOptions& o) {
  add_common_options(app, o);
  add_threads_and_seed(app, o);
  const auto positive = [&](const char* name, auto& target, const char* unit, const char* help,
                            double most = no_limit) {
    app.add_option_function<std::string>(
        name, [&target, name, unit, most](const std::string& t) { target = parse_positive(name, t, unit, most); },
        help);
  };
  const auto count = [&](const char* name, auto& target, std::int64_t least, std::int64_t most, const char* help) {
    app.add_option_function<std::string>(
        name,
        [&target, name, least, most](const std::string& t) {
          target = static_cast<std::remove_reference_t<decltype(target)>>(parse_count(name, t, least, most));
        },
        help);
  };
  positive("--time", o.time, "seconds", "Simulated seconds, from the start of the run (also after a resume)");
  count("--steps", o.steps, 1, most_steps, "Steps, from the start of the run");
  positive("--fps", o.fps, "frames a second", "Frames a simulated second (60)", most_frames_a_second);
  add_path(app, "--out", o.out, "Folder of the run (out/NAME)");
  app.add_option_function<std::string>(
      "--stats",
      [&](const std::string& t) {
        o.stats_each_frame = parse_word("--stats", t, {"step", "frame"}) == "frame";
      },
      "Rows of stats.csv: step or frame (step)");
  app.add_option_function<std::string>(
      "--columns",
      [&](const std::string& t) {
        o.full_columns = parse_word("--columns", t, {"basic", "full"}) == "full";
      },
      "Columns of stats.csv: basic or full (basic)");
  app.add_flag("--frames", o.frames, "Write PNG frames, off-screen")->disable_flag_override();
  app.add_option_function<std::string>(
      "--size", [&](const std::string& t) { parse_size(t, o.width, o.height); }, "Size of frames and video (1280x720)");
  add_path(app, "--video", o.video, "Write this mp4 (needs ffmpeg)");
  app.add_option_function<std::string>(
      "--particles-out",
      [&](const std::string& t) {
        o.particles_out = parse_word("--particles-out", t, {"vtk", "ply", "bgeo"});
      },
      "Write particles each frame: vtk, ply or bgeo");
  app.add_flag("--sub-particles", o.sub_particles,
               "In these, vortex sub-particles in place of particles that have split, with their radius")
      ->disable_flag_override();
  app.add_option_function<std::string>(
      "--mesh-out",
      [&](const std::string& t) {
        o.mesh_out = parse_word("--mesh-out", t, {"ply", "obj"});
      },
      "Write the water's surface each frame: ply or obj");
  positive("--checkpoint-every", o.checkpoint_every, "seconds", "Write a checkpoint each so many simulated seconds");
  add_path(app, "--resume", o.resume,
           "Go on from this checkpoint, to the same bits; tables and checkpoints beyond it go");
  count("--hash-passes", o.hash_passes, 1, most_steps, "Write passes.csv every so many steps: a hash after each pass");
  app.add_flag("--quiet", o.quiet, "Say nothing but errors")->disable_flag_override();
  app.add_flag("--overwrite", o.overwrite, "Replace what an earlier run left in the folder")->disable_flag_override();
}

void add_redo_options(CLI::App& app, RedoOptions& o) {
  const auto folder = [&o](const std::string& t) {
    if (t.empty()) throw InputError("DIR is empty, expected the folder of a run");
    o.folder = t;
  };
  app.add_option_function<std::string>("DIR", folder, "Folder of a run with --particles-out")->required();
  app.add_option("--set", o.settings, "key=value: a parameter of the surface (curlew params)")->allow_extra_args(false);
  app.add_option_function<std::string>(
      "--threads", [&](const std::string& t) { o.threads = parse_threads(t); }, "Threads (all cores)");
  app.add_flag("--quiet", o.quiet, "Say nothing but errors")->disable_flag_override();
  app.add_flag("--overwrite", o.overwrite, "Replace what is there")->disable_flag_override();
}

void add_mesh_options(CLI::App& app, RedoOptions& o) {
  add_redo_options(app, o);
  app.add_option_function<std::string>(
      "--mesh-out",
      [&](const std::string& t) {
        o.mesh_out = parse_word("--mesh-out", t, {"ply", "obj"});
      },
      "Format: ply or obj (ply)");
}

void add_render_options(CLI::App& app, RedoOptions& o) {
  add_redo_options(app, o);
  add_look(app, o.look);
  add_path(app, "--view", o.view, "Camera and look of this scene file instead of the run's own");
  app.add_option_function<std::string>(
      "--size", [&](const std::string& t) { parse_size(t, o.width, o.height); }, "Size of frames and video (1280x720)");
  add_path(app, "--video", o.video, "Write this mp4 too (needs ffmpeg)");
  app.add_option_function<std::string>(
      "--fps",
      [&](const std::string& t) { o.fps = parse_positive("--fps", t, "frames a second", most_frames_a_second); },
      "Frames a second of the video (60)");
}

void add_compare_options(CLI::App& app, CompareOptions& o) {
  const auto folder = [&app](const char* name, std::string& target, const char* help) {
    const auto take = [&target, name](const std::string& t) {
      if (t.empty()) throw InputError(std::string(name) + " is empty, expected the folder of a run");
      target = t;
    };
    app.add_option_function<std::string>(name, take, help)->required();
  };
  folder("GOLDEN", o.golden, "Folder of the run that is known to be good");
  folder("NEW", o.now, "Folder of the run to be judged");
  add_path(app, "--report", o.report, "Write the page here (NEW/compare.html)");
  app.add_flag("--accept", o.accept, "Let NEW take GOLDEN's place, whatever differs; exit code 0")
      ->disable_flag_override();
  app.add_flag("--quiet", o.quiet, "Say the verdict only")->disable_flag_override();
}

void add_bench_options(CLI::App& app, BenchOptions& o) {
  std::vector<std::string> names;
  std::string help = "Which:";
  for (const BenchRow& row : bench_table()) {
    names.push_back(row.name);
    help += "\n" + row.name + ": " + row.about;
  }
  const auto name = [&o, names](const std::string& t) { o.name = parse_word("the benchmark", t, names); };
  app.add_option_function<std::string>("NAME", name, help)->required();
  app.add_option("--cases", o.cases,
                 "Particle numbers (24k 97k; energy takes one: 30k; overhead too: 97k; turbulence too, across: 40; "
                 "stability too: 2k "
                 "in 2D, 5k in 3D; "
                 "accuracy: as its scenes have)");
  app.add_option("CASE", o.names, "accuracy: its cases (all); stability: its lines and planes (all)");
  app.add_option("--set", o.settings, "key=value: any parameter, repeatable")->allow_extra_args(false);
  app.add_option_function<std::string>(
      "--threads", [&](const std::string& t) { o.threads = parse_threads(t); }, "Threads (all cores)");
  app.add_option_function<std::string>(
      "--share", [&](const std::string& t) { o.time_share = parse_positive("--share", t, ""); },
      "speed, accuracy, turbulence: run this share of each case's time (1)");
  app.add_option_function<std::string>(
      "--at-least", [&](const std::string& t) { o.at_least = parse_positive("--at-least", t, ""); },
      "speed: exit 1 where a case makes fewer million particle-steps a second");
  app.add_option("--scenes", o.scenes,
                 "energy: dam_break, hemisphere (both); stability: dam_break_2d, dam_break (both)");
  app.add_option(
      "--methods", o.methods,
      "energy, overhead, turbulence, cavity, taylor_green_3d: dfsph, vr1.0, sum1.0, mp0.05, vc0.1, wt0.02 with "
      "any strength, or sums such as vr1.0+mp0.05 (those of the paper)");
  app.add_option("--settings", o.rows,
                 "accuracy, error against run time: which rows of its tables, such as default accurate (all)");
  app.add_option("--nu", o.nu, "energy: viscosities in m^2/s (0 0.05); cavity: 0.01, 0.001, 0.0001 (the last two)");
  app.add_option_function<std::string>(
      "--time", [&](const std::string& t) { o.time = parse_positive("--time", t, "seconds"); },
      "energy, stability, turbulence: simulated seconds (12, hemisphere 20, stability 4, turbulence two turnover "
      "times); overhead: seconds before it measures (0.4)");
  add_path(app, "--out", o.out,
           "energy, stability: folder (out/energy, out/stability); runs that are complete in it are not run again; "
           "accuracy, "
           "turbulence: folder for tables and plots (none)");
}

// An option that the benchmark would not read.
void check_bench_options(const CLI::App& app, const std::string& name) {
  std::vector<std::string> heeded = bench_row(name).options;
  for (const char* always : {"NAME", "--set", "--threads"}) heeded.emplace_back(always);
  for (const CLI::Option* option : app.get_options()) {
    const bool known = std::find(heeded.begin(), heeded.end(), option->get_name()) != heeded.end();
    if (option->count() > 0 && !known) {
      throw InputError("curlew bench " + name + " takes no " + option->get_name() + "; see `curlew bench --help`");
    }
  }
}

std::string called(const CLI::App& app) { return app.get_parent() == nullptr ? "curlew" : "curlew " + app.get_name(); }

// A word that no command takes: one that is not known, or an option that stands before its command.
[[noreturn]] void report_extra(const CLI::App& app, const CLI::App& command) {
  const bool before = command.remaining().empty();  // the words left over stand before the command, if there is one
  const CLI::App& owner = before ? app : command;
  const std::string word = owner.remaining().empty() ? "" : owner.remaining().front();
  const bool is_option = word.starts_with("-");
  const std::string name = is_option ? word.substr(0, word.find('=')) : word;
  std::vector<std::string> known, own;
  for (const CLI::Option* option : owner.get_options()) known.push_back(option->get_name());
  for (const CLI::Option* option : command.get_options()) own.push_back(option->get_name());
  for (const CLI::App* sub : app.get_subcommands({})) {
    if (&owner == &app) known.push_back(sub->get_name());
  }
  if (&owner != &command && std::find(own.begin(), own.end(), name) != own.end()) {
    throw InputError(in_quotes(name) + " stands before " + in_quotes(command.get_name()) + ", expected it after");
  }
  const std::string near = nearest_name(name, known);
  const std::string advice =
      near.empty() ? "; `" + called(owner) + " --help` lists what there is" : "; did you mean \"" + near + "\"?";
  if (!is_option && &owner != &app) {
    throw InputError(called(owner) + ": found " + in_quotes(name) + ", expected no further argument" + advice);
  }
  throw InputError(called(owner) + " has no " + (is_option ? "option " : "command ") + in_quotes(name) + advice);
}

// What CLI11 could not make sense of, as one sentence of ours: its own words differ between versions.
[[noreturn]] void report_usage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  for (const CLI::App* sub : app.get_subcommands()) command = sub;
  const auto kind = static_cast<CLI::ExitCodes>(error.get_exit_code());
  if (kind == CLI::ExitCodes::ExtrasError) report_extra(app, *command);
  std::string what = error.what();
  if (kind == CLI::ExitCodes::ArgumentMismatch) {
    const std::string option = what.substr(0, what.find_first_of(": "));
    if (what.find("flag override") != std::string::npos) {
      what = (option.starts_with("-") ? option : "--" + option) + " takes no value";
    } else {
      what = option + (what.find("received") != std::string::npos ? " was given more than once" : " needs a value");
    }
  }
  if (!what.empty() && what.back() == '.') what.pop_back();
  throw InputError(what + "; see `" + called(*command) + " --help`");
}

}  // namespace

int dispatch(int argc, char** argv) {
  CLI::App app("Curlew: an interactive, real-time simulator of turbulent water", "curlew");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(0, 1);

  RunOptions run;
  BenchOptions bench;
  for (int k = 0; k < argc; ++k) run.command += (k == 0 ? "" : " ") + std::string(k == 0 ? "curlew" : argv[k]);
  bench.command = run.command;

  CLI::App* gui = app.add_subcommand("gui", "Open the window");
  add_common_options(*gui, run);
  add_threads_and_seed(*gui, run);
  CLI::App* run_app = app.add_subcommand("run", "Simulate with no window; write what is asked for");
  add_run_options(*run_app, run);
  CLI::App* check = app.add_subcommand("check", "Read a scene and say what it holds");
  add_common_options(*check, run);
  RedoOptions redo;
  CLI::App* mesh_app = app.add_subcommand("mesh", "Make the water's surface from the particle files of a run");
  add_mesh_options(*mesh_app, redo);
  CLI::App* render_app = app.add_subcommand("render", "Draw frames again from the particle files of a run");
  add_render_options(*render_app, redo);
  CompareOptions compare;
  CLI::App* compare_app =
      app.add_subcommand("compare", "Say what changed between two runs: parameter, simulation or rendering");
  add_compare_options(*compare_app, compare);
  CLI::App* bench_app = app.add_subcommand("bench", "Measure: speed, memory, energy, overhead, stability, accuracy");
  add_bench_options(*bench_app, bench);
  CLI::App* scenes = app.add_subcommand("scenes", "List the bundled scenes");
  CLI::App* params = app.add_subcommand("params", "List all parameters");
  bool json = false, markdown = false, schema = false;
  params->add_flag("--json", json, "As JSON");
  params->add_flag("--markdown", markdown, "As a Markdown table");
  params->add_flag("--schema", schema, "The JSON schema of a scene file");
  CLI::App* doctor = app.add_subcommand("doctor", "Say what this machine can do");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {  // --help, --version
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    report_usage(app, error);
  }
  if (run_app->parsed()) return run_command(run);
  if (check->parsed()) return check_command(run);
  if (mesh_app->parsed()) return mesh_command(redo);
  if (render_app->parsed()) return render_command(redo);
  if (compare_app->parsed()) return compare_command(compare);
  if (bench_app->parsed()) {
    check_bench_options(*bench_app, bench.name);
    return bench_command(bench);
  }
  if (scenes->parsed()) return scenes_command();
  if (doctor->parsed()) return doctor_command();
  if (params->parsed()) {
    if (json + markdown + schema > 1) throw InputError("curlew params takes one of --json, --markdown and --schema");
    return params_command(json       ? ParameterFormat::json
                          : markdown ? ParameterFormat::markdown
                          : schema   ? ParameterFormat::schema
                                     : ParameterFormat::text);
  }
  return gui_command(run);
}

}  // namespace curlew
