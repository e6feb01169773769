#include "tests/app/run_files.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "tests/io/temporary_folder.h"

namespace curlew::test {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

std::size_t Table::place(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  INFO(column);
  REQUIRE(found != columns.end());
  return static_cast<std::size_t>(found - columns.begin());
}

double Table::number(std::size_t row, const std::string& column) const {
  const std::string& text = cell(row, column);
  std::size_t end = 0;
  const double value = std::stod(text, &end);
  INFO(column << " is " << text);
  REQUIRE(end == text.size());
  return value;
}

Table read_table(const std::string& file) {
  const std::string text = file_text(file);
  INFO(file);
  REQUIRE_FALSE(text.empty());
  REQUIRE(text.back() == '\n');
  std::istringstream lines(text);
  Table table;
  for (std::string line; std::getline(lines, line);) {
    if (table.columns.empty()) {
      table.columns = split(line);
      continue;
    }
    table.rows.push_back(split(line));
    REQUIRE(table.rows.back().size() == table.columns.size());
  }
  return table;
}

std::vector<std::string> comparable_rows(const Table& table) {
  std::vector<std::string> rows;
  for (const auto& cells : table.rows) {
    std::string row;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::string& column = table.columns[k];
      if (column.starts_with("ms_") || column == "state_hash") continue;
      row += column + "=" + cells[k] + " ";
    }
    rows.push_back(row);
  }
  return rows;
}

nlohmann::json read_json(const std::string& file) { return nlohmann::json::parse(file_text(file)); }

Table run_in(const std::string& folder, const std::string& line, const std::string& name) {
  std::vector<std::string> words = words_of(line);
  words.insert(words.end(), {"--out", name, "--quiet"});
  const Outcome outcome = curlew_program(words, {folder, {}, {}, 240});
  INFO(line << "\n" << outcome.err);
  REQUIRE(outcome.code == 0);
  return read_table(folder + "/" + name + "/stats.csv");
}

std::vector<std::string> unfinished_files(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.find(".unfinished") != std::string::npos || name.ends_with(".part"))
      names.push_back(entry.path().string());
  }
  return names;
}

std::string last_checkpoint(const std::string& run_folder) {
  std::string last;
  for (const auto& entry : std::filesystem::directory_iterator(run_folder + "/checkpoints")) {
    if (entry.path().extension() == ".curlew") last = std::max(last, entry.path().string());
  }
  return last;
}

}  // namespace curlew::test
