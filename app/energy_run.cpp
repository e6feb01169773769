#include "app/energy_run.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "sim/core/error.h"
#include "sim/core/passes.h"
#include "sim/io/atomic_file.h"
#include "sim/io/csv.h"
#include "sim/measure/diagnostics.h"

namespace curlew {
namespace {

constexpr double rows_a_second = 60;

// The columns, in their order; a note stands behind them.
struct Column {
  const char* name;
  std::vector<double> EnergyHistory::*values;
};
constexpr Column columns[] = {{"time", &EnergyHistory::time},
                              {"kinetic", &EnergyHistory::kinetic},
                              {"rotational", &EnergyHistory::rotational},
                              {"potential", &EnergyHistory::potential},
                              {"mechanical", &EnergyHistory::mechanical},
                              {"total", &EnergyHistory::total},
                              {"increase", &EnergyHistory::increase}};

std::vector<std::string> header() {
  std::vector<std::string> names;
  for (const Column& column : columns) names.emplace_back(column.name);
  names.emplace_back("note");
  return names;
}

// Between rows, linear; a run may end up to a step after the reference, which is then as it was last.
double mechanical_at(const EnergyHistory& history, double time) {
  const auto after = std::lower_bound(history.time.begin(), history.time.end(), time);
  if (after == history.time.end()) return history.complete() ? history.mechanical.back() : NAN;
  const auto k = static_cast<std::size_t>(after - history.time.begin());
  if (k == 0) return history.mechanical.front();
  const double share = (time - history.time[k - 1]) / (history.time[k] - history.time[k - 1]);
  return std::lerp(history.mechanical[k - 1], history.mechanical[k], share);
}

void write_row(CsvWriter& csv, const World& world, const EnergyHistory* reference, const std::string& note) {
  const Diagnostics d = diagnose(world);
  const double increase = reference == nullptr ? 0 : d.mechanical() / mechanical_at(*reference, world.time) - 1;
  std::vector<std::string> cells;
  for (const double value : {world.time, d.kinetic, d.rotational, d.potential, d.mechanical(), d.total(), increase}) {
    cells.push_back(std::isfinite(value) ? number_text(value) : "");
  }
  cells.push_back(note);
  csv.row(cells);
}

std::string divergence_note(const World& world, const DivergedError& error) {
  char text[160];
  std::snprintf(text, sizeof text, "diverged at %.3f s in pass %s", world.time, error.pass.c_str());
  return text;
}

enum class End { done, stopped };

End fill(CsvWriter& csv, World& world, double end, const EnergyHistory* reference,
         const std::function<bool(double)>& show) {
  const Plan plan = make_plan(world);
  prepare(world, plan);
  write_row(csv, world, reference, "");
  for (double next = 1 / rows_a_second; world.time < end;) {
    try {
      step(world, plan);
    } catch (const DivergedError& error) {
      write_row(csv, world, reference, divergence_note(world, error));
      return End::done;
    }
    if (!show(world.time)) return End::stopped;
    if (world.time < next && world.time < end) continue;
    write_row(csv, world, reference, "");
    next = (std::floor(world.time * rows_a_second + 1e-9) + 1) / rows_a_second;
  }
  return End::done;
}

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& what) {
  throw InputError(file + ": line " + std::to_string(line) + " " + what + "; remove the file to run it again");
}

double parse_cell(const std::string& cell, const std::string& file, std::size_t line) {
  if (cell.empty()) return NAN;
  double value = 0;
  const char* last = cell.data() + cell.size();
  const auto [end, status] = std::from_chars(cell.data(), last, value);
  if (status != std::errc() || end != last) refuse(file, line, "holds \"" + cell + "\", expected a number");
  return value;
}

// A note has no comma, so that no cell is quoted.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

}  // namespace

double mean_over(const EnergyHistory& history, const std::vector<double>& column, double begin, double end) {
  double sum = 0, rows = 0;
  for (std::size_t k = 0; k < history.size(); ++k) {
    if (history.time[k] >= begin && history.time[k] <= end) sum += column[k], rows += 1;
  }
  return rows > 0 ? sum / rows : NAN;
}

bool simulate_energies(const Scene& scene, double end, const EnergyHistory* reference, const std::string& file,
                       const std::function<bool(double)>& show) {
  const std::string unfinished = file + std::string(unfinished_suffix);
  World world = make_world(scene);
  CsvWriter csv(unfinished, header());
  const End how = fill(csv, world, end, reference, show);
  csv.close();
  std::error_code error;
  if (how == End::stopped) {
    std::filesystem::remove(unfinished, error);
    return false;
  }
  std::filesystem::rename(unfinished, file, error);
  if (error) throw InputError(write_error(file, error.value()));
  return true;
}

EnergyHistory read_energies(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  EnergyHistory history;
  std::string text;
  std::size_t line = 0;
  while (std::getline(in, text)) {
    const std::vector<std::string> cells = cells_of(text);
    if (++line == 1 && cells != header()) refuse(file, line, "is not the header of a run of this benchmark");
    if (cells.size() != header().size()) refuse(file, line, "has " + std::to_string(cells.size()) + " cells");
    if (line == 1) continue;
    for (std::size_t k = 0; k < std::size(columns); ++k) {
      (history.*columns[k].values).push_back(parse_cell(cells[k], file, line));
    }
    history.note = cells.back();
  }
  if (history.size() == 0) throw InputError("cannot read " + file + ": it holds no row; remove it to run it again");
  return history;
}

}  // namespace curlew
