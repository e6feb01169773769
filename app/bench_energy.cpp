// `curlew bench energy`: the energy figures of Liu et al. 2020 (Fig. 7 and 10), each method beside plain DFSPH, with
// and without viscosity. Hours of work at their size, so what is complete in the folder is not run again.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/bench.h"
#include "app/energy_report.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "sim/core/error.h"
#include "sim/io/atomic_file.h"
#include "sim/scene/json.h"
#include "sim/scene/sampling.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;

const EnergyScene known_scenes[] = {{"dam_break", "Dam break", 12, 2, 8},
                                    {"hemisphere", "Dam break over a hemisphere", 20, 2, 15}};

// A scene with all that is to run in it.
struct Series {
  EnergyScene what;
  Scene scene;
  std::string folder;
  double end;  // s
  std::vector<Method> methods;
  std::vector<double> nus;

  std::string file(const Method& method, double nu) const {
    return folder + "/nu" + number_text(nu) + "_" + method_name(method) + ".csv";
  }
  std::string run_text() const {
    return std::to_string(count_particles(scene)) + " particles, " + number_text(end) + " s";
  }
};

const EnergyScene& known_scene(const std::string& name) {
  for (const EnergyScene& scene : known_scenes) {
    if (scene.name == name) return scene;
  }
  throw InputError("--scenes is " + in_quotes(name) + ", expected dam_break or hemisphere");
}

std::vector<double> viscosities(const BenchOptions& options) {
  if (options.nu.empty()) return {0, 0.05};
  std::vector<double> nus;
  for (const std::string& text : options.nu) {
    Parameters checked;
    set_parameter(checked, parameter_row("viscosity.nu"), text, "--nu");
    const double nu = checked.viscosity.nu;
    if (std::find(nus.begin(), nus.end(), nu) == nus.end()) nus.push_back(nu);
  }
  return nus;
}

// The reference runs first, asked for or not.
std::vector<Method> methods_of(const BenchOptions& options) {
  std::vector<Method> methods = options.methods.empty() ? paper_methods() : parse_methods(options.methods);
  std::erase(methods, Method{});
  methods.insert(methods.begin(), Method{});
  return methods;
}

std::vector<Series> plan_series(const BenchOptions& options) {
  check_free(options.settings, {"viscosity.nu"});
  std::vector<std::string> names = options.scenes;
  if (names.empty()) names = {"dam_break", "hemisphere"};
  std::vector<Series> all;
  for (const std::string& name : names) {
    const EnergyScene& what = known_scene(name);
    const Scene scene = bench_scene(name, 0, single_case(options, "30k"), options);
    const std::string out = options.out.empty() ? "out/energy" : options.out;
    all.push_back(
        {what, scene, out + "/" + name, options.time.value_or(what.time), methods_of(options), viscosities(options)});
  }
  return all;
}

// What all runs of a folder share: a run under other settings must not pass for one of these.
std::string shared_settings(const Series& series, const BenchOptions& options) {
  std::string text = series.what.name + ", particle_radius " + number_text(series.scene.particle_radius) + ", " +
                     number_text(series.end) + " s";
  for (const std::string& setting : options.settings) text += ", " + setting;
  return text + "\n";
}

void claim_folder(const Series& series, const BenchOptions& options) {
  const std::string file = series.folder + "/settings.txt", text = shared_settings(series, options);
  if (std::error_code ignored; !fs::exists(file, ignored)) {
    AtomicFile out(file);
    out.write(text);
    return out.commit();
  }
  std::ifstream in(file, std::ios::binary);
  const std::string found{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (found != text) {
    throw InputError(file + " says that the runs beside it are of " + found.substr(0, found.find('\n')) +
                     ", expected " + text.substr(0, text.size() - 1) + "; choose another --out");
  }
}

struct Job {
  const Series* series;
  Method method;
  double nu;
};

std::vector<Job> missing_runs(const std::vector<Series>& all) {
  std::vector<Job> jobs;
  for (const Series& series : all) {
    for (const double nu : series.nus) {
      for (const Method& method : series.methods) {
        if (!fs::exists(series.file(method, nu))) jobs.push_back({&series, method, nu});
      }
    }
  }
  return jobs;
}

// False where Ctrl-C ended it.
bool run_missing(const std::vector<Series>& all) {
  const std::vector<Job> jobs = missing_runs(all);
  double total = 0, done = 0;
  for (const Job& job : jobs) total += job.series->end;
  Progress progress(false);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const Series& series = *jobs[k].series;
    const Method& method = jobs[k].method;
    const double nu = jobs[k].nu;
    Scene scene = series.scene;
    scene.parameters.viscosity.nu = nu;
    apply_method(scene.parameters, method);
    char label[120];
    std::snprintf(label, sizeof label, "run %zu of %zu: %s, nu %g, %s", k + 1, jobs.size(), series.what.name.c_str(),
                  nu, method_label(method).c_str());
    const auto show = [&](double time) {
      const double here = std::min(time, series.end);
      progress.show((done + here) / total, label + (", t " + number_text(std::round(100 * here) / 100) + " s"));
      return !interrupted();
    };
    EnergyHistory plain;
    if (!method.is_plain()) plain = read_energies(series.file(Method{}, nu));
    const EnergyHistory* reference = method.is_plain() ? nullptr : &plain;
    if (!simulate_energies(scene, series.end, reference, series.file(method, nu), show)) return false;
    done += series.end;
  }
  return true;
}

void write_text(const std::string& file, const std::string& text) {
  AtomicFile out(file);
  out.write(text);
  out.commit();
}

void report(const Series& series, const std::string& command) {
  std::vector<EnergyCurve> curves;
  for (const double nu : series.nus) {
    for (const Method& method : series.methods) {
      curves.push_back({method, nu, read_energies(series.file(method, nu))});
    }
  }
  const std::string run = series.run_text(), table = energy_table(series.what, curves, run, command);
  write_text(series.folder + "/summary.md", table);
  std::printf("%s\n", table.c_str());
  for (const double nu : series.nus) {
    const std::string file = series.folder + "/energy_nu" + number_text(nu) + ".svg";
    write_svg(file, energy_plot(series.what, curves, nu, run, command));
    std::printf("%s\n", file.c_str());
  }
  std::printf("\n");
}

}  // namespace

int bench_energy(const BenchOptions& asked) {
  BenchOptions options = asked;
  // What the methods do by themselves, as in the papers, unless --set says otherwise.
  options.settings.insert(options.settings.begin(), "energy.guard=false");
  const std::vector<Series> all = plan_series(options);
  for (const Series& series : all) claim_folder(series, options);
  watch_for_interrupt();
  if (!run_missing(all)) {
    std::printf("interrupted; the same command goes on with the run that was in hand\n");
    return 130;
  }
  for (const Series& series : all) report(series, options.command);
  return 0;
}

}  // namespace curlew
