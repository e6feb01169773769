#include "app/run_record.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "app/options.h"
#include "sim/core/error.h"
#include "sim/scene/file_text.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_text = 4'000'000'000;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells{""};
  for (const char c : line) {
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

const JsonNode* member(const JsonNode& node, const std::string& key) {
  const auto at = std::find(node.keys.begin(), node.keys.end(), key);
  return at == node.keys.end() ? nullptr : &node.items[static_cast<std::size_t>(at - node.keys.begin())];
}

// Sorted; none where there is no such folder.
std::vector<std::string> names_in(const fs::path& folder, const char* extension) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (fs::directory_iterator at(folder, ignored), end; !ignored && at != end; at.increment(ignored)) {
    if (at->path().extension() == extension) names.push_back(at->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// What a command line says of the frames' rate, which run.json has nowhere else.
std::optional<double> fps_of(const std::string& command) {
  std::istringstream words(command);
  std::string text;
  for (std::string word; words >> word;) {
    if (word == "--fps") words >> text;
    if (word.starts_with("--fps=")) text = word.substr(6);
  }
  if (text.empty()) return RunOptions{}.fps;
  double fps = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), fps);
  if (status != std::errc() || end != text.data() + text.size() || !(fps > 0)) return std::nullopt;
  return fps;
}

}  // namespace

std::optional<std::size_t> TextTable::column(const std::string& name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

TextTable read_text_table(const fs::path& file) {
  const std::string text = read_file(file, largest_text, "a table of a run");
  TextTable table;
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::vector<std::string> cells = cells_of(text.substr(at, end - at));
    at = end + 1;
    if (line == 1) {
      table.columns = std::move(cells);
    } else if (cells.size() != table.columns.size()) {
      throw InputError(file.string() + ": line " + std::to_string(line) + " has " + std::to_string(cells.size()) +
                       " cells, expected " + std::to_string(table.columns.size()) + " as in the first line");
    } else {
      table.rows.push_back(std::move(cells));
    }
  }
  return table;
}

std::string RunRecord::state_hash() const { return stats.rows.back()[*stats.column("state_hash")]; }

const JsonNode* RunRecord::found(std::initializer_list<const char*> path) const {
  const JsonNode* node = &json;
  for (const char* key : path) {
    if (node != nullptr) node = member(*node, key);
  }
  return node;
}

std::string RunRecord::text(std::initializer_list<const char*> path) const {
  const JsonNode* node = found(path);
  return node == nullptr ? "" : node->text;
}

std::optional<double> RunRecord::fps() const {
  const JsonNode *frames_made = found({"result", "frames"}), *end = found({"result", "time"});
  const std::optional<double> fps = fps_of(text({"command"}));
  if (!fps || frames_made == nullptr || end == nullptr) return std::nullopt;
  const bool agrees = frame_at(end->number, *fps) + 1 == frames_made->number;
  return agrees ? fps : std::nullopt;
}

double frame_at(double time, double fps) { return std::floor(time * fps + 1e-9); }

RunRecord read_run(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": there is no such folder, expected one of a run");
  RunRecord run;
  run.folder = folder;
  run.json = parse_json(read_file(folder / "run.json", 100'000'000, "a run's run.json"), folder / "run.json");
  for (const char* key : {"scene", "program", "result"}) {
    if (run.found({key}) == nullptr)
      throw InputError((folder / "run.json").string() + ": has no \"" + key + "\", expected the run.json of a run");
  }
  if (const std::string status = run.text({"result", "status"}); status != "done") {
    throw InputError((folder / "run.json").string() + ": the run is " + in_quotes(status) +
                     ", expected one that is done");
  }
  run.stats = read_text_table(folder / "stats.csv");
  if (run.stats.rows.empty() || !run.stats.column("state_hash") || run.state_hash().empty())
    throw InputError((folder / "stats.csv").string() + ": has no hash of the last state, expected that of a whole run");
  std::error_code ignored;
  if (fs::exists(folder / "passes.csv", ignored)) run.passes = read_text_table(folder / "passes.csv");
  run.frames = names_in(folder / "frames", ".png");
  run.checkpoints = names_in(folder / "checkpoints", ".curlew");
  return run;
}

}  // namespace curlew
