// What a finished run left in its folder, read back: for comparing two of them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/json.h"

namespace curlew {

// A CSV table with its cells as text; all rows have as many as there are columns.
struct TextTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  // The column's number, or nothing.
  std::optional<std::size_t> column(const std::string& name) const;
};

// Throws InputError where the file is missing, empty or ragged.
TextTable read_text_table(const std::filesystem::path& file);

struct RunRecord {
  std::filesystem::path folder;
  JsonNode json;                         // run.json
  TextTable stats;                       // stats.csv, at least one row
  std::optional<TextTable> passes;       // passes.csv
  std::vector<std::string> frames;       // names in frames/, in order
  std::vector<std::string> checkpoints;  // names in checkpoints/, in order

  std::string state_hash() const;  // of the last row
  // An item of run.json: found({"program", "renderer"}); null where there is none.
  const JsonNode* found(std::initializer_list<const char*> path) const;
  std::string text(std::initializer_list<const char*> path) const;  // empty where there is none
  // Frames a simulated second, of a run that made them all itself: what the command says, where as many frames as that
  // gives were made. Nothing for a run that was resumed.
  std::optional<double> fps() const;
};

// The number of the frame that shows `time`, or the last before it, as `curlew run` counts; a whole number.
double frame_at(double time, double fps);

// Throws InputError, naming the file, where the folder is not that of a finished run.
RunRecord read_run(const std::filesystem::path& folder);

}  // namespace curlew
