#include "app/stability_report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <set>

#include "sim/core/error.h"
#include "sim/core/params.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

constexpr const char* plain_name = "plain";

// Behind scene, particles, map, the axes and guard.
constexpr const char* result_columns[] = {"verdict", "gains",  "kinetic_ratio",   "gain_percent", "end",     "pass",
                                          "steps",   "sweeps", "most_iterations", "limit_hits",   "kinetic", "wall"};

std::string join(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + cell;
  return line;
}

std::vector<std::string> header() {
  std::vector<std::string> names = {"scene", "particles", "map"};
  for (const StabilityAxis& axis : stability_axes()) names.push_back(axis.name);
  names.emplace_back("guard");
  names.insert(names.end(), std::begin(result_columns), std::end(result_columns));
  return names;
}

// What tells a cell from all others: the cells up to guard.
std::string place_of(const std::string& scene, std::size_t particles, const std::string& map,
                     const StabilityPoint& point) {
  std::vector<std::string> cells = {scene, std::to_string(particles), map};
  for (const StabilityAxis& axis : stability_axes()) cells.push_back(number_text(point.*axis.value));
  cells.emplace_back(point.guard ? "on" : "off");
  return join(cells);
}

std::string finite_text(double value) { return std::isfinite(value) ? number_text(value) : ""; }

std::string result_text(const StabilityRun& run, double plain_kinetic) {
  return join({verdict_name(classify(run, plain_kinetic)), run.gain_percent > noted_gain_percent ? "yes" : "no",
               finite_text(run.kinetic / plain_kinetic), finite_text(run.gain_percent), number_text(run.end),
               run.pass.empty() ? "-" : run.pass, std::to_string(run.steps), std::to_string(run.sweeps),
               std::to_string(run.most_iterations), std::to_string(run.limit_hits), finite_text(run.kinetic),
               number_text(std::round(100 * run.wall) / 100)});
}

// One line of the file, by the names of its columns.
class Row {
 public:
  Row(const std::string& line, std::string place) : place_(std::move(place)) {
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      cells_.push_back(line.substr(begin, end - begin));
      begin = end + 1;
    }
    const std::size_t expected = header().size();
    if (cells_.size() != expected) {
      refuse("has " + std::to_string(cells_.size()) + " cells, expected " + std::to_string(expected));
    }
  }

  const std::string& text(const std::string& column) const {
    const std::vector<std::string> names = header();
    return cells_[static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin())];
  }

  template <class T = double>
  T number(const std::string& column) const {
    const std::string& cell = text(column);
    if constexpr (std::is_same_v<T, double>) {
      if (cell.empty()) return NAN;
    }
    T value{};
    const char* last = cell.data() + cell.size();
    const auto [end, status] = std::from_chars(cell.data(), last, value);
    if (status != std::errc() || end != last) refuse("holds \"" + cell + "\" for " + column + ", expected a number");
    return value;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(place_ + " " + what + "; remove the line, or the file, to run it again");
  }

 private:
  std::string place_;
  std::vector<std::string> cells_;
};

StabilityRun run_of(const Row& row) {
  StabilityRun run;
  const auto verdict = parse_verdict(row.text("verdict"));
  if (!verdict)
    row.refuse("holds \"" + row.text("verdict") + "\" for verdict, expected calm, lively, diverged or too slow");
  run.end = row.number("end");
  if (*verdict == Verdict::diverged) run.pass = row.text("pass");
  run.too_slow = *verdict == Verdict::too_slow;
  run.kinetic = row.number("kinetic");
  run.gain_percent = row.number("gain_percent");
  run.steps = row.number<std::int64_t>("steps");
  run.sweeps = row.number<std::uint64_t>("sweeps");
  run.most_iterations = row.number<int>("most_iterations");
  run.limit_hits = row.number<std::int64_t>("limit_hits");
  run.wall = row.number("wall");
  return run;
}

std::vector<std::string> lines_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// f(map's name, point as the map has it) for all cells of a scene, the plain runs first.
void for_cells(const StabilityScene& scene, const std::vector<StabilityMap>& maps,
               const std::function<void(const std::string&, const StabilityPoint&)>& f) {
  for (const auto& [resolution, particles] : scene.particles) f(plain_name, plain_point(resolution));
  for (const StabilityMap& map : maps) {
    for (const bool guard : {false, true}) {
      for (const double y : map.ys) {
        for (const double x : map.xs) f(map.name, map.at(x, y, guard));
      }
    }
  }
}

struct Shown {
  const StabilityRun& run;
  Verdict verdict;
  double ratio;
};

Shown shown(const StabilityScene& scene, const StabilityPoint& point, const StabilityRuns& runs) {
  const StabilityRun& run = runs.at(stability_key(scene, point));
  const double plain = runs.at(stability_key(scene, plain_point(point.resolution))).kinetic;
  return {run, classify(run, plain), run.kinetic / plain};
}

std::string short_text(const char* pattern, double value) {
  char text[60];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

// "2 (0.41 s, density_solve)": the first value on a line with one of these verdicts, or a dash.
std::string first_text(const StabilityScene& scene, const StabilityMap& line, bool guard, const StabilityRuns& runs,
                       bool broken) {
  for (const double x : line.xs) {
    const Shown cell = shown(scene, line.at(x, 0, guard), runs);
    const std::string value = number_text(x);
    if (!broken && cell.verdict == Verdict::lively) return value + short_text(" (%.2f times)", cell.ratio);
    if (broken && cell.verdict == Verdict::too_slow) return value + short_text(" (too slow, %.2f s)", cell.run.end);
    if (broken && cell.verdict == Verdict::diverged) {
      return value + short_text(" (%.2f s, ", cell.run.end) + cell.run.pass + ")";
    }
  }
  return "-";
}

std::string gain_text(const StabilityScene& scene, const StabilityMap& line, bool guard, const StabilityRuns& runs) {
  for (const double x : line.xs) {
    const Shown cell = shown(scene, line.at(x, 0, guard), runs);
    if (cell.run.gain_percent > noted_gain_percent) {
      return number_text(x) + short_text(" (%.3g %%)", cell.run.gain_percent);
    }
  }
  return "-";
}

std::string definition() {
  return "Lively: in the last " + number_text(last_part) + " s more than " + number_text(lively_over_plain) +
         " times the kinetic energy of plain DFSPH at the same resolution, else calm. Too slow: more than " +
         number_text(most_work_ratio) + " times plain DFSPH's sweeps over the neighbours.";
}

HeatCell heat_cell(const Shown& cell) {
  const bool broken = cell.verdict == Verdict::diverged || cell.verdict == Verdict::too_slow;
  const char* pattern = cell.ratio < 100 ? "× %.2f" : "× %.2g";
  return {static_cast<int>(cell.verdict), verdict_name(cell.verdict),
          broken ? short_text("%.2f s", cell.run.end) : short_text(pattern, cell.ratio),
          cell.run.gain_percent > noted_gain_percent};
}

HeatAxis heat_axis(const StabilityAxis& axis, const std::vector<double>& values) {
  HeatAxis out{axis.title, {}, -1};
  for (const double value : values) out.labels.push_back(number_text(value));
  const auto limit = std::find_if(values.begin(), values.end(), [&](double v) { return v >= axis.limit - 1e-9; });
  if (limit != values.end()) out.limit = static_cast<int>(limit - values.begin());
  return out;
}

std::string guard_text(bool guard) { return guard ? "guard on" : "guard off"; }

HeatPanel line_panel(const StabilityPlan& plan, const StabilityMap& line, const StabilityRuns& runs) {
  HeatPanel panel{line.fixed, heat_axis(*line.x, line.xs), {}, {}};
  for (auto scene = plan.scenes.rbegin(); scene != plan.scenes.rend(); ++scene) {
    for (const bool guard : {true, false}) {
      panel.y.labels.push_back(scene->label + ", " + guard_text(guard));
      for (const double x : line.xs) panel.cells.push_back(heat_cell(shown(*scene, line.at(x, 0, guard), runs)));
    }
  }
  return panel;
}

HeatPanel plane_panel(const StabilityScene& scene, const StabilityMap& map, bool guard, const StabilityRuns& runs) {
  HeatPanel panel{scene.label + ", " + guard_text(guard), heat_axis(*map.x, map.xs), heat_axis(*map.y, map.ys), {}};
  for (const double y : map.ys) {
    for (const double x : map.xs) panel.cells.push_back(heat_cell(shown(scene, map.at(x, y, guard), runs)));
  }
  return panel;
}

// The sentences below a picture of these maps.
std::vector<std::string> notes_for(const std::vector<const StabilityMap*>& maps, const std::string& about) {
  std::vector<std::string> notes = {about + ". " + definition() +
                                    " Below the word: kinetic energy over plain DFSPH's, or the time reached."};
  notes.push_back("Filled corner: the total energy rose more than " + number_text(noted_gain_percent) +
                  " % above its start.");
  std::set<std::string> said;
  for (const StabilityMap* map : maps) {
    for (const StabilityAxis* axis : {map->x, map->y}) {
      if (axis == nullptr || axis->said.empty() || !said.insert(axis->said).second) continue;
      notes.push_back("Red bar: " + axis->said + ", say Liu et al. 2020.");
    }
  }
  return notes;
}

HeatMap empty_map(const std::string& title, const std::string& command) {
  return {title, 2,
          {},    {{"#d3e7f4", "#14384f"}, {"#f0a63c", "#3a2200"}, {"#6d1a36", "#ffffff"}, {"#6a6a6a", "#ffffff"}},
          {},    command};
}

}  // namespace

StabilityPoint plain_point(double resolution) {
  StabilityPoint point;
  point.resolution = resolution;
  return point;
}

StabilityKey stability_key(const StabilityScene& scene, const StabilityPoint& point) {
  return {scene.name, scene.particles_at(point), canonical(point)};
}

StabilityRuns read_stability(const std::string& file) {
  StabilityRuns runs;
  const std::vector<std::string> lines = lines_of(file);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string place = file + ": line " + std::to_string(k + 1);
    if (k == 0) {
      if (lines[0] != join(header())) {
        throw InputError(place + " is not the header of this benchmark's cells; remove the file to run them again");
      }
      continue;
    }
    const Row row(lines[k], place);
    StabilityPoint point;
    for (const StabilityAxis& axis : stability_axes()) point.*axis.value = row.number(axis.name);
    point.guard = row.text("guard") == "on";
    runs[{row.text("scene"), row.number<std::size_t>("particles"), canonical(point)}] = run_of(row);
  }
  return runs;
}

void write_stability(const std::string& file, const StabilityPlan& plan, const StabilityRuns& runs) {
  std::string own;
  std::set<std::string> places;
  for (const StabilityScene& scene : plan.scenes) {
    for_cells(scene, plan.maps, [&](const std::string& map, const StabilityPoint& point) {
      const auto run = runs.find(stability_key(scene, point));
      const auto plain = runs.find(stability_key(scene, plain_point(point.resolution)));
      if (run == runs.end() || plain == runs.end()) return;
      const std::string place = place_of(scene.name, scene.particles_at(point), map, point);
      places.insert(place);
      own += place + "," + result_text(run->second, plain->second.kinetic) + "\n";
    });
  }
  std::string others;
  const std::vector<std::string> lines = lines_of(file);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    std::size_t cut = 0;  // the comma behind the place
    for (std::size_t n = 0; n < 4 + stability_axes().size(); ++n) cut = lines[k].find(',', cut) + 1;
    if (!places.contains(lines[k].substr(0, cut - 1))) others += lines[k] + "\n";
  }
  AtomicFile out(file);
  out.write(join(header()) + "\n" + others + own);
  out.commit();
}

std::string stability_summary(const StabilityPlan& plan, const StabilityRuns& runs, const std::string& about) {
  std::string out =
      about + ". " + definition() +
      " In the table the first value on each line: that is lively, and how "
      "many times; that breaks, when, and in which pass; at which the total energy rose more than " +
      number_text(noted_gain_percent) + " % above its start, and how far. A dash: none.\n\n" +
      "| line | values | scene | lively, guard off | on | breaks, guard off | on | gains, guard off | on |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const StabilityMap& line : plan.maps) {
    if (!line.is_line()) continue;
    for (const StabilityScene& scene : plan.scenes) {
      out += "| " + line.x->title + (line.fixed.empty() ? "" : ", at " + line.fixed) + " | " +
             number_text(line.xs.front()) + " to " + number_text(line.xs.back()) + " | " + scene.label;
      for (const bool broken : {false, true}) {
        for (const bool guard : {false, true}) out += " | " + first_text(scene, line, guard, runs, broken);
      }
      for (const bool guard : {false, true}) out += " | " + gain_text(scene, line, guard, runs);
      out += " |\n";
    }
  }
  return out;
}

std::map<std::string, HeatMap> stability_pictures(const StabilityPlan& plan, const StabilityRuns& runs,
                                                  const std::string& about, const std::string& command) {
  std::map<std::string, HeatMap> pictures;
  std::vector<const StabilityMap*> lines;
  for (const StabilityMap& map : plan.maps) {
    if (map.is_line()) {
      lines.push_back(&map);
      const auto at =
          pictures.try_emplace("lines.svg", empty_map("Where it breaks: one value at a time", command)).first;
      at->second.panels.push_back(line_panel(plan, map, runs));
      continue;
    }
    HeatMap picture = empty_map("Where it breaks: " + map.x->title + " and " + map.y->title, command);
    for (const StabilityScene& scene : plan.scenes) {
      for (const bool guard : {false, true}) picture.panels.push_back(plane_panel(scene, map, guard, runs));
    }
    picture.notes = notes_for({&map}, about);
    pictures.emplace(map.name + ".svg", picture);
  }
  if (!lines.empty()) pictures.at("lines.svg").notes = notes_for(lines, about);
  return pictures;
}

}  // namespace curlew
