// `curlew bench`: the table of the benchmarks, and what they share.
#include "app/bench.h"

#include <omp.h>

#include <algorithm>

#include "app/accuracy.h"
#include "app/assets.h"
#include "app/commands.h"
#include "app/numbers.h"
#include "app/setup.h"
#include "sim/core/error.h"
#include "sim/scene/bundled.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"

namespace curlew {

std::span<const BenchRow> bench_table() {
  static const BenchRow rows[] = {
      {"speed", "time a step and a particle, of the dam break", {"--cases", "--share", "--at-least"}, bench_speed},
      {"memory", "bytes a particle", {"--cases"}, bench_memory},
      {"energy",
       "how much energy each turbulence method keeps, and whether the water calms down (Liu et al. 2020, Fig. 7, 10)",
       {"--cases", "--scenes", "--methods", "--nu", "--time", "--out"},
       bench_energy},
      {"overhead",
       "what each turbulence method costs over plain DFSPH",
       {"--cases", "--methods", "--time"},
       bench_overhead},
      {"turbulence",
       "the energy spectrum of decaying turbulence with each method, and that of the wavelet noise, beside k^(-5/3)",
       {"--cases", "--methods", "--time", "--share", "--out"},
       bench_turbulence},
      {"stability",
       "where the simulation breaks: strengths of the methods, time step, viscosity, resolution",
       {"CASE", "--cases", "--scenes", "--time", "--out"},
       bench_stability},
      {"surface", "what the mesh of the water's surface costs", {"--share"}, bench_surface},
      {"render", "what a picture costs in each look, without a window", {"--cases", "--share"}, bench_render},
      {"accuracy",
       "errors against exact answers: gresho_chan, lamb_oseen, taylor_vortex, spinning_drop with every turbulence "
       "method; "
       "taylor_green, taylor_green_1000, couette, poiseuille, hydrostatic, standing_wave, square_patch, "
       "oscillating_drop, dam_break_front as error against run time; "
       "and where they are named, for hours, cavity and taylor_green_3d beside what others have computed",
       {"CASE", "--cases", "--methods", "--settings", "--nu", "--share", "--out"},
       accuracy_bench},
  };
  return rows;
}

const BenchRow& bench_row(const std::string& name) {
  const auto rows = bench_table();
  return *std::find_if(rows.begin(), rows.end(), [&](const BenchRow& row) { return row.name == name; });
}

Scene bench_scene(const std::string& name, double nu, const std::string& particles, const BenchOptions& options) {
  Scene scene = read_scene(find_scene(name, assets_folder()));
  scene.parameters.viscosity.nu = nu;
  apply_settings(scene.parameters, options.settings);
  return with_particles(scene, parse_particle_number("--cases", particles));
}

std::string single_case(const BenchOptions& options, const std::string& otherwise) {
  if (options.cases.size() > 1) {
    throw InputError("--cases has " + std::to_string(options.cases.size()) + " numbers, and this benchmark takes one");
  }
  return options.cases.empty() ? otherwise : options.cases.front();
}

void fix_iterations(PressureParameters& pressure) {
  pressure.max_iterations = 13;
  pressure.max_divergence_iterations = 2;
  pressure.density_tolerance = pressure.divergence_tolerance = 1e-7;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

int bench_command(const BenchOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  return bench_row(options.name).run(options);
}

}  // namespace curlew
