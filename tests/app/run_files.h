// Reads what a run leaves behind: stats.csv as a table, run.json as a tree.
#pragma once

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace curlew::test {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::size_t place(const std::string& column) const;
  const std::string& cell(std::size_t row, const std::string& column) const { return rows.at(row).at(place(column)); }
  double number(std::size_t row, const std::string& column) const;
  std::string last_hash() const { return rows.empty() ? "no row" : cell(rows.size() - 1, "state_hash"); }
};

// Requires whole lines of as many cells as the header.
Table read_table(const std::string& file);

// A table without what may differ between two equal runs: wall times, and the hash, which stands in the last row of
// each part of a run only.
std::vector<std::string> comparable_rows(const Table& table);

nlohmann::json read_json(const std::string& file);

// Runs in `folder`, requires success, and gives the table of the run that `--out NAME` names.
Table run_in(const std::string& folder, const std::string& line, const std::string& name);

// Files whose names say that they are half written.
std::vector<std::string> unfinished_files(const std::string& folder);

// The checkpoint of the latest step.
std::string last_checkpoint(const std::string& run_folder);

}  // namespace curlew::test
