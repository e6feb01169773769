// `curlew bench accuracy`: the table of cases, and what they share.
#include <omp.h>

#include <cstdio>
#include <filesystem>
#include <functional>

#include "app/accuracy.h"
#include "app/assets.h"
#include "app/methods.h"
#include "app/numbers.h"
#include "app/setup.h"
#include "app/work_precision.h"
#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/io/csv.h"
#include "sim/scene/bundled.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

struct AccuracyCase {
  std::string name;
  std::function<void(const BenchOptions&)> run;
  bool takes_methods = false, takes_nu = false;
  bool is_long = false;  // hours: only where it is named
  const PrecisionCase* precision = nullptr;
};

// Vortices and a drop with every turbulence method; then error against run time; then flows that others have computed.
std::vector<AccuracyCase> all_cases() {
  std::vector<AccuracyCase> cases = {
      {"gresho_chan", gresho_chan_accuracy},
      {"lamb_oseen", lamb_oseen_accuracy},
      {"taylor_vortex", taylor_vortex_accuracy},
      {"spinning_drop", spinning_drop_accuracy},
  };
  for (const PrecisionCase& c : precision_cases()) {
    const auto run = [&c](const BenchOptions& options) { run_precision_case(c, options); };
    cases.push_back({.name = c.name, .run = run, .precision = &c});
  }
  cases.push_back({"cavity", cavity_accuracy, true, true, true});
  cases.push_back({"taylor_green_3d", taylor_green_3d_accuracy, true, false, true});
  return cases;
}

const AccuracyCase& case_of_name(const std::vector<AccuracyCase>& cases, const std::string& name) {
  std::string known;
  for (const AccuracyCase& c : cases) {
    if (c.name == name) return c;
    known += (known.empty() ? "" : ", ") + c.name;
  }
  throw InputError("there is no accuracy case \"" + name + "\", expected one of " + known);
}

// Throws InputError where a case does not read an option that was given.
void check_read(const AccuracyCase& c, const BenchOptions& options) {
  const auto refuse = [&](const std::string& option) {
    throw InputError("the accuracy case " + c.name + " takes no " + option);
  };
  if (!options.methods.empty() && !c.takes_methods) refuse("--methods");
  if (!options.nu.empty() && !c.takes_nu) refuse("--nu");
  if (!options.rows.empty() && c.precision == nullptr) refuse("--settings");
  if (c.precision != nullptr) settings_of(*c.precision, options);
  if (c.takes_nu) check_cavity_nu(options);
}

void print_row(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) std::printf("| %s ", cell.c_str());
  std::printf("|\n");
}

}  // namespace

const std::vector<AccuracyMethod>& accuracy_methods() {
  static const std::vector<AccuracyMethod> methods = {
      {"DFSPH", {}},
      {"VC 0.01", {"vorticity_confinement.epsilon=0.01"}},
      {"VC 0.1", {"vorticity_confinement.epsilon=0.1"}},
      {"MP 0.05", {"micropolar.nu_t=0.05", "micropolar.eta=0"}},
      {"VR 1 sum", {"vorticity_refinement.alpha=1", "vorticity_refinement.reconstruction=sum"}},
      {"VR 1", {"vorticity_refinement.alpha=1", "vorticity_refinement.reconstruction=poisson"}},
  };
  return methods;
}

std::vector<Scene> accuracy_scenes(const std::string& name, const BenchOptions& options) {
  Scene scene = read_scene(find_scene(name, assets_folder()));
  scene.parameters.energy.guard = false;  // what the methods do by themselves, unless --set says otherwise
  apply_settings(scene.parameters, options.settings);
  std::vector<Scene> scenes;
  for (const std::string& text : options.cases) {
    scenes.push_back(with_particles(scene, parse_particle_number("--cases", text)));
  }
  if (scenes.empty()) scenes.push_back(scene);
  return scenes;
}

Scene with_method(Scene scene, const AccuracyMethod& method) {
  apply_settings(scene.parameters, method.settings);
  return scene;
}

void AccuracyTable::print() const {
  print_row(columns);
  for (std::size_t k = 0; k < columns.size(); ++k) std::printf("|---");
  std::printf("|\n");
  for (const auto& row : rows) print_row(row);
  std::fflush(stdout);
}

void AccuracyTable::write(const std::string& name, const BenchOptions& options) const {
  if (options.out.empty()) return;
  std::error_code error;  // CsvWriter says what is wrong
  std::filesystem::create_directories(options.out, error);
  CsvWriter file(options.out + "/" + name + ".csv", columns);
  for (const auto& row : rows) file.row(row);
  file.close();
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

int accuracy_bench(const BenchOptions& options) {
  check_free(options.settings, {"viscosity.nu", "vorticity_refinement.reconstruction", "micropolar.eta",
                                "micropolar.curls", "micropolar.model"});
  const std::vector<AccuracyCase> cases = all_cases();
  std::vector<const AccuracyCase*> chosen;  // all names are looked up before the first case is run
  for (const std::string& name : options.names) chosen.push_back(&case_of_name(cases, name));
  if (chosen.empty()) {
    for (const AccuracyCase& c : cases) {
      if (!c.is_long) chosen.push_back(&c);
    }
  }
  for (const AccuracyCase* c : chosen) check_read(*c, options);
  std::printf("%d threads, %s\n", omp_get_max_threads(), CURLEW_ISA_NAME);
  for (const AccuracyCase* c : chosen) c->run(options);
  return 0;
}

}  // namespace curlew
