#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "app/commands.h"
#include "app/numbers.h"
#include "sim/core/error.h"
#include "sim/core/nearest_name.h"

namespace curlew {
namespace {

double parse_positive(const std::string& option, const std::string& text, const std::string& unit) {
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [end, status] = std::from_chars(text.data(), last, value);
  if (status != std::errc() || end != last || !std::isfinite(value) || value <= 0) {
    throw InputError(option + " is \"" + text + "\", expected a positive number" + (unit.empty() ? "" : " of " + unit));
  }
  return value;
}

std::int64_t parse_count(const std::string& option, const std::string& text, std::int64_t least) {
  std::int64_t value = 0;
  const char* last = text.data() + text.size();
  const auto [end, status] = std::from_chars(text.data(), last, value);
  if (status != std::errc() || end != last || value < least) {
    throw InputError(option + " is \"" + text + "\", expected a whole number of at least " + std::to_string(least));
  }
  return value;
}

void parse_size(const std::string& text, int& width, int& height) {
  const auto cross = text.find('x');
  int* numbers[] = {&width, &height};
  const std::string parts[] = {text.substr(0, cross), cross == std::string::npos ? "" : text.substr(cross + 1)};
  for (int k = 0; k < 2; ++k) {
    const char* last = parts[k].data() + parts[k].size();
    const auto [end, status] = std::from_chars(parts[k].data(), last, *numbers[k]);
    if (parts[k].empty() || status != std::errc() || end != last || *numbers[k] < 16 || *numbers[k] > 8192) {
      throw InputError("--size is \"" + text + "\", expected WIDTHxHEIGHT such as 1280x720, each from 16 to 8192");
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
  throw InputError(option + " is \"" + text + "\", expected " + all);
}

// Options are read as text and checked here, so that every message is ours.
void add_common_options(CLI::App& app, RunOptions& o) {
  app.add_option("SCENE", o.scene, "Scene file, or the name of a bundled scene (curlew scenes)");
  app.add_option("--set", o.settings, "key=value: any parameter (curlew params), repeatable")->allow_extra_args(false);
  const auto radius = [&](const std::string& t) { o.radius = parse_positive("--radius", t, "metres"); };
  app.add_option_function<std::string>("--radius", radius, "Particle radius in m");
  const auto particles = [&](const std::string& t) { o.particles = parse_particle_number("--particles", t); };
  app.add_option_function<std::string>("--particles", particles, "Resolution that comes nearest: 24k, 1.2M, 1e5");
}

void add_run_options(CLI::App& app, RunOptions& o) {
  add_common_options(app, o);
  const auto positive = [&](const char* name, auto& target, const char* unit, const char* help) {
    app.add_option_function<std::string>(
        name, [&target, name, unit](const std::string& t) { target = parse_positive(name, t, unit); }, help);
  };
  const auto count = [&](const char* name, auto& target, std::int64_t least, const char* help) {
    app.add_option_function<std::string>(
        name,
        [&target, name, least](const std::string& t) {
          using Target = std::remove_reference_t<decltype(target)>;
          if constexpr (std::is_same_v<Target, std::optional<std::int64_t>>) {
            target = parse_count(name, t, least);
          } else {
            const std::int64_t value = parse_count(name, t, least);
            target = static_cast<Target>(value);
            if (static_cast<std::int64_t>(target) != value) {
              throw InputError(std::string(name) + " is \"" + t + "\", which is too large");
            }
          }
        },
        help);
  };
  positive("--time", o.time, "seconds", "Simulated seconds, from the start of the run (also after a resume)");
  count("--steps", o.steps, 1, "Steps, from the start of the run");
  positive("--fps", o.fps, "frames a second", "Frames a simulated second (60)");
  count("--threads", o.threads, 1, "Threads (all cores)");
  count("--seed", o.seed, 0, "Seed of all random numbers (0)");
  app.add_option("--out", o.out, "Folder of the run (out/NAME)");
  app.add_option_function<std::string>(
      "--stats", [&](const std::string& t) { o.stats_each_frame = parse_word("--stats", t, {"step", "frame"}) == "frame"; },
      "Rows of stats.csv: step or frame (step)");
  app.add_option_function<std::string>(
      "--columns", [&](const std::string& t) { o.full_columns = parse_word("--columns", t, {"basic", "full"}) == "full"; },
      "Columns of stats.csv: basic or full (basic)");
  app.add_flag("--frames", o.frames, "Write PNG frames, off-screen");
  app.add_option_function<std::string>(
      "--size", [&](const std::string& t) { parse_size(t, o.width, o.height); }, "Size of frames and video (1280x720)");
  app.add_option("--video", o.video, "Write this mp4 (needs ffmpeg)");
  app.add_option_function<std::string>(
      "--particles-out",
      [&](const std::string& t) { o.particles_out = parse_word("--particles-out", t, {"vtk", "ply", "bgeo"}); },
      "Write particles each frame: vtk, ply or bgeo");
  positive("--checkpoint-every", o.checkpoint_every, "seconds", "Write a checkpoint each so many simulated seconds");
  app.add_option("--resume", o.resume, "Go on from this checkpoint, to the same bits");
  count("--hash-passes", o.hash_passes, 1, "Write passes.csv every so many steps: a hash after each pass");
  app.add_flag("--quiet", o.quiet, "Say nothing but errors");
  app.add_flag("--overwrite", o.overwrite, "Replace what an earlier run left in the folder");
}

void add_bench_options(CLI::App& app, BenchOptions& o) {
  app.add_option_function<std::string>(
      "NAME", [&](const std::string& t) { o.name = parse_word("the benchmark", t, {"speed", "memory"}); },
      "speed or memory")->required();
  app.add_option("--cases", o.cases, "Particle numbers (24k 97k)");
  app.add_option("--set", o.settings, "key=value: any parameter, repeatable")->allow_extra_args(false);
  app.add_option_function<std::string>(
      "--threads", [&](const std::string& t) { o.threads = static_cast<int>(parse_count("--threads", t, 1)); },
      "Threads (all cores)");
  app.add_option_function<std::string>(
      "--share", [&](const std::string& t) { o.time_share = parse_positive("--share", t, ""); },
      "Run this share of each case's time (1)");
  app.add_option_function<std::string>(
      "--at-least", [&](const std::string& t) { o.at_least = parse_positive("--at-least", t, ""); },
      "Exit 1 where a case makes fewer million particle-steps a second");
}

// What CLI11 could not make sense of, as one sentence of ours.
[[noreturn]] void report_usage(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& args) {
  const CLI::App* command = &app;
  for (const CLI::App* sub : app.get_subcommands()) command = sub;
  const std::string name = command == &app ? "curlew" : "curlew " + command->get_name();
  std::vector<std::string> known;
  for (const CLI::Option* option : command->get_options()) known.push_back(option->get_name());
  for (const CLI::App* sub : app.get_subcommands({})) {
    if (command == &app) known.push_back(sub->get_name());
  }
  if (error.get_name() == "ExtrasError") {
    const std::vector<std::string> rest = command->remaining().empty() ? app.remaining() : command->remaining();
    const std::string word = rest.empty() ? (args.empty() ? "" : args.front()) : rest.front();
    const std::string bare = word.substr(0, word.find('='));
    const std::string near = nearest_name(bare, known);
    const std::string kind = word.starts_with("-") ? "option" : command == &app ? "command" : "argument";
    throw InputError(name + " has no " + kind + " \"" + bare + "\"" +
                     (near.empty() ? "; `" + name + " --help` lists them" : "; did you mean \"" + near + "\"?"));
  }
  std::string what = error.what();
  if (!what.empty() && what.back() == '.') what.pop_back();
  throw InputError(name + ": " + what + "; see `" + name + " --help`");
}

}  // namespace

int dispatch(int argc, char** argv) {
  CLI::App app("Curlew: an interactive, real-time simulator of turbulent water", "curlew");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(0, 1);

  RunOptions run;
  BenchOptions bench;
  std::string gui_scene;
  for (int k = 0; k < argc; ++k) run.command += (k == 0 ? "" : " ") + std::string(k == 0 ? "curlew" : argv[k]);

  CLI::App* gui = app.add_subcommand("gui", "Open the window");
  gui->add_option("SCENE", gui_scene, "Scene file, or the name of a bundled scene");
  CLI::App* run_app = app.add_subcommand("run", "Simulate with no window; write what is asked for");
  add_run_options(*run_app, run);
  CLI::App* check = app.add_subcommand("check", "Read a scene and say what it holds");
  add_common_options(*check, run);
  CLI::App* bench_app = app.add_subcommand("bench", "Measure: speed, memory");
  add_bench_options(*bench_app, bench);
  CLI::App* scenes = app.add_subcommand("scenes", "List the bundled scenes");
  CLI::App* params = app.add_subcommand("params", "List all parameters");
  bool json = false, markdown = false, schema = false;
  params->add_flag("--json", json, "As JSON");
  params->add_flag("--markdown", markdown, "As a Markdown table");
  params->add_flag("--schema", schema, "The JSON schema of a scene file");
  CLI::App* doctor = app.add_subcommand("doctor", "Say what this machine can do");

  const std::vector<std::string> args(argv + 1, argv + argc);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {  // --help, --version
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    report_usage(app, error, args);
  }
  if (run_app->parsed()) return run_command(run);
  if (check->parsed()) return check_command(run);
  if (bench_app->parsed()) return bench_command(bench);
  if (scenes->parsed()) return scenes_command();
  if (doctor->parsed()) return doctor_command();
  if (params->parsed()) {
    if (json + markdown + schema > 1) throw InputError("curlew params takes one of --json, --markdown and --schema");
    return params_command(json       ? ParameterFormat::json
                          : markdown ? ParameterFormat::markdown
                          : schema   ? ParameterFormat::schema
                                     : ParameterFormat::text);
  }
  return gui_command(gui_scene);
}

}  // namespace curlew
