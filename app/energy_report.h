// What `curlew bench energy` says about its runs: a table in Markdown and plots in the manner of Liu et al. 2020,
// Fig. 7 and 10.
#pragma once

#include <string>
#include <vector>

#include "app/energy_run.h"
#include "app/methods.h"
#include "app/svg_plot.h"

namespace curlew {

struct EnergyScene {
  std::string name, title;
  double time;                  // s, that the paper's figure shows
  double flow_begin, flow_end;  // s, while the paper calls the water flowing
};

struct EnergyCurve {
  Method method;
  double nu;
  EnergyHistory history;
};

// The methods of the paper's figures, plain DFSPH first, and both models at once.
const std::vector<Method>& paper_methods();

// Curves in the order of the table; each viscosity has one without a method. `run` says what ran, such as the number of
// particles.
std::string energy_table(const EnergyScene& scene, const std::vector<EnergyCurve>& curves, const std::string& run,
                         const std::string& command);

// Of the curves with this viscosity.
Plot energy_plot(const EnergyScene& scene, const std::vector<EnergyCurve>& curves, double nu, const std::string& run,
                 const std::string& command);

}  // namespace curlew
