#include "app/compare.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/commands.h"
#include "render/png.h"
#include "sim/core/error.h"
#include "sim/core/params.h"
#include "sim/io/atomic_file.h"
#include "sim/io/run_folder.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json_place.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;
using Kind = Comparison::Kind;

std::string short_text(const JsonNode& node) {
  std::string text = json_text(node);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

bool same_node(const JsonNode& a, const JsonNode& b) { return json_text(a) == json_text(b); }

// Lists where two trees differ, by the path of keys.
void list_changes(const JsonNode& golden, const JsonNode& now, const std::string& path,
                  std::vector<std::string>& changes) {
  const std::string here = path.empty() ? "the scene" : path;
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (golden.type == JsonNode::Type::object && now.type == JsonNode::Type::object) {
    const auto place = [](const JsonNode& node, const std::string& key) {
      return static_cast<std::size_t>(std::find(node.keys.begin(), node.keys.end(), key) - node.keys.begin());
    };
    for (std::size_t k = 0; k < golden.keys.size(); ++k) {
      const std::size_t other = place(now, golden.keys[k]);
      if (other < now.keys.size())
        list_changes(golden.items[k], now.items[other], below(golden.keys[k]), changes);
      else
        changes.push_back(below(golden.keys[k]) + " is " + short_text(golden.items[k]) +
                          " in GOLDEN and absent in NEW");
    }
    for (std::size_t k = 0; k < now.keys.size(); ++k) {
      if (place(golden, now.keys[k]) == golden.keys.size())
        changes.push_back(below(now.keys[k]) + " is absent in GOLDEN and " + short_text(now.items[k]) + " in NEW");
    }
    return;
  }
  if (golden.type == JsonNode::Type::array && now.type == JsonNode::Type::array &&
      golden.items.size() == now.items.size() && !golden.items.empty() &&
      golden.items.front().type == JsonNode::Type::object) {
    for (std::size_t k = 0; k < golden.items.size(); ++k)
      list_changes(golden.items[k], now.items[k], here + "[" + std::to_string(k) + "]", changes);
    return;
  }
  // Files stand with their whole path, which another machine has otherwise.
  const bool same_file = path.ends_with(".file") && fs::path(golden.text).filename() == fs::path(now.text).filename();
  if (!same_node(golden, now) && !same_file)
    changes.push_back(here + " is " + short_text(golden) + " in GOLDEN and " + short_text(now) + " in NEW");
}

// The look and the camera change pictures, everything else the simulation.
bool is_of_picture(const std::string& change) {
  return change.starts_with("look.") || change.starts_with("camera") || change.starts_with("parameters.surface.");
}

bool same_item(const RunRecord& a, const RunRecord& b, std::initializer_list<const char*> path) {
  return a.text(path) == b.text(path);
}

std::optional<double> number_of(const std::string& text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<StateRow> compare_state(const RunRecord& golden, const RunRecord& now, const CompareTolerances& allowed) {
  std::vector<StateRow> rows;
  for (std::size_t k = 0; k < golden.stats.columns.size(); ++k) {
    const std::string& name = golden.stats.columns[k];
    const auto other = now.stats.column(name);
    if (name.starts_with("ms_") || name == "state_hash" || !other) continue;
    StateRow row{name, golden.stats.rows.back()[k], now.stats.rows.back()[*other], 0, true};
    const auto a = number_of(row.golden), b = number_of(row.now);
    if (a && b) {
      const double largest = std::max(std::abs(*a), std::abs(*b)), apart = std::abs(*a - *b);
      row.difference = largest > 0 ? apart / largest : 0;
      for (const StateTolerance& t : allowed.state) {
        if (t.column == name) row.allowed = apart <= t.absolute || row.difference <= t.share;
      }
    }
    rows.push_back(row);
  }
  return rows;
}

// "step 12 in the pass density_solve", from the passes where both runs hashed them, else from the rows of stats.csv.
std::string first_difference(const RunRecord& golden, const RunRecord& now) {
  if (golden.passes && now.passes) {
    const auto &a = golden.passes->rows, &b = now.passes->rows;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
      if (a[k] == b[k]) continue;
      if (a[k][0] != b[k][0]) return "step " + a[k][0] + ", where the hashes were written for other steps";
      if (a[k][1] != b[k][1]) return "step " + a[k][0] + ", where " + b[k][1] + " runs in place of " + a[k][1];
      return "step " + a[k][0] + " in the pass " + a[k][1];
    }
  }
  const auto compared = [](const TextTable& table, const std::vector<std::string>& row) {
    std::vector<std::string> cells;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!table.columns[k].starts_with("ms_") && table.columns[k] != "state_hash") cells.push_back(row[k]);
    }
    return cells;
  };
  const auto &a = golden.stats.rows, &b = now.stats.rows;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    if (compared(golden.stats, a[k]) != compared(now.stats, b[k]))
      return "step " + a[k][0] + " or shortly before (run both with --hash-passes 1 to learn the pass)";
  }
  return "step " + (a.size() < b.size() ? a : b).back()[0];
}

std::vector<PictureRow> compare_pictures(const RunRecord& golden, const RunRecord& now,
                                         const PictureTolerance& allowed) {
  std::vector<PictureRow> rows;
  for (const std::string& name : golden.frames) {
    if (std::find(now.frames.begin(), now.frames.end(), name) == now.frames.end()) {
      rows.push_back({name, {1, 255, 255, 0, false}, false});
      continue;
    }
    const Image a = read_png(golden.folder / "frames" / name), b = read_png(now.folder / "frames" / name);
    const PictureDifference difference = picture_difference(a, b, allowed.channel);
    rows.push_back({name, difference, allowed.accepts(difference)});
  }
  return rows;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

// The worst of the pictures, in words.
std::string worst_picture(const std::vector<PictureRow>& rows) {
  const auto worst = std::min_element(rows.begin(), rows.end(), [](const PictureRow& a, const PictureRow& b) {
    return a.difference.ssim < b.difference.ssim;
  });
  char text[64];
  std::snprintf(text, sizeof text, "SSIM %.4f", worst->difference.ssim);
  return worst->name + " differs most, in " + percent(worst->difference.share) + " of its pixels (" + text + ")";
}

PictureTolerance read_picture_tolerance(const JsonPlace& place) {
  place.allow({"channel", "share", "mean", "ssim"});
  return {static_cast<int>(place.at("channel").number(0, 1e9)), place.at("share").number(0, 1e9),
          place.at("mean").number(0, 1e9), place.at("ssim").number(0, 1e9)};
}

}  // namespace

CompareTolerances default_tolerances() {
  CompareTolerances t;
  t.state = {{"particles", 0, 0},
             {"kinetic", 0.02, 1e-6},
             {"rotational", 0.05, 1e-6},
             {"potential", 0.005, 1e-6},
             {"mechanical", 0.005, 1e-6},
             {"total", 0.005, 1e-6},
             {"max_speed", 0.2, 1e-4},
             {"density_error_true_avg", 0.3, 2e-4},
             {"density_error_true_max", 1, 0.02},
             {"outside", 0, 0},
             {"enstrophy", 0.05, 1e-6},
             {"px", 0.05, 1e-3},
             {"py", 0.05, 1e-3},
             {"pz", 0.05, 1e-3}};
  t.tight = {4, 0.001, 0.05, 0.999};
  t.loose = {24, 0.02, 1.5, 0.95};
  return t;
}

CompareTolerances read_tolerances(const fs::path& file) {
  const JsonNode node = parse_json(read_file(file, 10'000'000, "tolerances"), file);
  const JsonPlace place(node, file);
  place.allow({"state", "tight", "loose"});
  CompareTolerances t = default_tolerances();
  if (const auto tight = place.find("tight")) t.tight = read_picture_tolerance(*tight);
  if (const auto loose = place.find("loose")) t.loose = read_picture_tolerance(*loose);
  if (const auto state = place.find("state")) {
    t.state.clear();
    for (const std::string& column : state->node().keys) {
      const JsonPlace row = state->at(column);
      row.allow({"share", "absolute"});
      t.state.push_back({column, row.at("share").number(0, 1e9), row.at("absolute").number(0, 1e9)});
    }
  }
  return t;
}

namespace {

std::vector<std::string> changes_of_scene(const RunRecord& golden, const RunRecord& now) {
  std::vector<std::string> changed;
  list_changes(*golden.found({"scene"}), *now.found({"scene"}), "", changed);
  const JsonNode *seed = golden.found({"seed"}), *new_seed = now.found({"seed"});
  if (seed != nullptr && new_seed != nullptr && !same_node(*seed, *new_seed))
    changed.push_back("the seed is " + short_text(*seed) + " in GOLDEN and " + short_text(*new_seed) + " in NEW");
  return changed;
}

bool all_allowed(const auto& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.allowed; });
}

// The verdict on NEW's state and pictures.
void judge(Comparison& c, const RunRecord& golden, const RunRecord& now, bool same_bits_expected) {
  const bool same_state = golden.state_hash() == now.state_hash();
  const bool same_pictures = std::all_of(c.pictures.begin(), c.pictures.end(),
                                         [](const PictureRow& r) { return r.allowed && r.difference.largest == 0; });
  const bool drawn_as_before = !c.redrawn.rows.empty() && all_allowed(c.redrawn.rows);
  const bool simulation_changed =
      std::any_of(c.changed.begin(), c.changed.end(), [](const std::string& s) { return !is_of_picture(s); });
  if (!c.changed.empty() && (simulation_changed || !same_pictures)) {
    c.kind = Kind::parameter;
    c.verdict = (c.changed.front().starts_with("parameters.") ? "a parameter differs: " : "the scene differs: ") +
                c.changed.front();
    if (c.changed.size() > 1) c.verdict += ", and " + std::to_string(c.changed.size() - 1) + " more";
  } else if (!same_state && (same_bits_expected || !all_allowed(c.state))) {
    c.kind = Kind::simulation;
    c.verdict = "the simulation first differed at " + first_difference(golden, now);
  } else if (!same_state && !all_allowed(c.pictures) && drawn_as_before) {
    c.kind = Kind::simulation;
    c.verdict = "the simulation changed, within the tolerances of its state but not of its pictures: " +
                worst_picture(c.pictures) + ", and the golden's stored state is drawn as before";
  } else if (!all_allowed(c.pictures)) {
    c.kind = Kind::rendering;
    c.verdict = "the rendering changed: " + worst_picture(c.pictures);
    if (same_state) c.verdict += ", of the same state";
  } else if (same_state && same_pictures) {
    c.verdict = golden.frames.empty() ? "identical: the same state" : "identical: the same state and the same pictures";
  } else {
    c.kind = Kind::within_tolerance;
    c.verdict = same_state ? "the same state, and pictures within the tolerance" : "the same within the tolerances";
  }
}

// GOLDEN's state drawn otherwise than then is the rendering's doing, whatever else differs.
void judge_redrawn(Comparison& c) {
  if (all_allowed(c.redrawn.rows)) return;
  const bool more = c.kind == Kind::parameter || c.kind == Kind::simulation;
  c.verdict = "the rendering changed: " + worst_picture(c.redrawn.rows) + ", of the golden's stored state" +
              (more ? "; and " + c.verdict : "");
  c.kind = Kind::rendering;
}

}  // namespace

Comparison compare_runs(const RunRecord& golden, const RunRecord& now) {
  Comparison c;
  std::error_code ignored;
  const fs::path own = golden.folder / "compare.json";
  c.tolerances = fs::exists(own, ignored) ? read_tolerances(own) : default_tolerances();
  c.changed = changes_of_scene(golden, now);

  const bool same_bits_expected =
      same_item(golden, now, {"program", "compiler"}) && same_item(golden, now, {"program", "instruction_set"});
  const bool same_renderer =
      same_item(golden, now, {"program", "renderer"}) && same_item(golden, now, {"program", "opengl"});
  const bool same_state = golden.state_hash() == now.state_hash();
  c.picture_tolerance = same_state && same_renderer ? c.tolerances.tight : c.tolerances.loose;
  c.state = compare_state(golden, now, c.tolerances);
  c.pictures = compare_pictures(golden, now, c.picture_tolerance);
  c.redrawn = redraw_stored_states(golden, c.tolerances.tight);
  if (!golden.frames.empty() && !same_renderer) {
    c.warnings.push_back("GOLDEN was drawn by " + golden.text({"program", "renderer"}) + ", NEW by " +
                         now.text({"program", "renderer"}) + ": only the loose tolerance counts for pictures");
  }
  if (!same_bits_expected) {
    c.warnings.push_back(
        "the runs come from different compilers or instruction sets: their states need not have the same bits, and the "
        "tolerances count");
  }
  if (!c.redrawn.warning.empty()) c.warnings.push_back(c.redrawn.warning);
  judge(c, golden, now, same_bits_expected);
  judge_redrawn(c);
  return c;
}

namespace {

// What a run is compared by takes the place of what the golden folder had; its tolerances stay.
void accept_run(const RunRecord& golden, const RunRecord& now) {
  prepare_run_folder(golden.folder.string(), true);
  const auto copy = [&](const fs::path& name) {
    std::error_code error;
    if (!fs::exists(now.folder / name, error)) return;
    fs::create_directories((golden.folder / name).parent_path(), error);
    fs::copy_file(now.folder / name, golden.folder / name, fs::copy_options::overwrite_existing, error);
    if (error) throw InputError("cannot write " + (golden.folder / name).string() + ": " + error.message());
  };
  for (const std::string& frame : now.frames) copy(fs::path("frames") / frame);
  for (const std::string& checkpoint : now.checkpoints) copy(fs::path("checkpoints") / checkpoint);
  for (const char* name : {"stats.csv", "passes.csv", "probes.csv", "run.json"}) copy(name);  // run.json makes it whole
}

void warn(const std::string& sentence) { std::fprintf(stderr, "curlew: warning: %s\n", sentence.c_str()); }

}  // namespace

int compare_command(const CompareOptions& options) {
  const RunRecord golden = read_run(options.golden), now = read_run(options.now);
  const Comparison c = compare_runs(golden, now);
  for (const std::string& warning : c.warnings) warn(warning);
  std::printf("%s\n", c.verdict.c_str());
  const std::string page = options.report.empty() ? options.now + "/compare.html" : options.report;
  AtomicFile file(page);
  file.write(comparison_page(c, golden, now));
  file.commit();
  if (!options.quiet) std::printf("report: %s\n", page.c_str());
  if (options.accept) {
    accept_run(golden, now);
    if (now.checkpoints.empty() && !golden.checkpoints.empty())
      warn("GOLDEN's checkpoints are gone, for NEW has none; run it with --checkpoint-every to store states again");
    if (!options.quiet)
      std::printf("accepted: %s now holds what %s does\n", options.golden.c_str(), options.now.c_str());
    return 0;
  }
  return c.passed() ? 0 : 1;
}

}  // namespace curlew
