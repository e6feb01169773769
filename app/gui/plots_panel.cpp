// Plots over the run's time.
#include <imgui.h>

#include <algorithm>

#include "app/gui/interface.h"
#include "app/gui/style.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

Plot energy_plot(std::span<const Sample> samples) {
  Plot plot{"Energy",
            "J",
            {{"total", [](const Sample& s) { return s.kinetic + s.rotational + s.potential; }},
             {"kinetic", [](const Sample& s) { return s.kinetic; }},
             {"potential", [](const Sample& s) { return s.potential; }}},
            false};
  // Only where a model has spins.
  if (std::any_of(samples.begin(), samples.end(), [](const Sample& s) { return s.rotational != 0; })) {
    plot.series.push_back({"rotational", [](const Sample& s) { return s.rotational; }});
  }
  return plot;
}

// Those that are the same in all runs.
std::vector<Plot> make_plots() {
  std::vector<Plot> plots = {
      {"Compression",
       "%",
       {{"true", [](const Sample& s) { return 100 * s.compression; }},
        {"solved", [](const Sample& s) { return 100 * s.compression_target; }},
        {"divergence", [](const Sample& s) { return 100 * s.divergence_error; }}},
       true},
      {"Iterations",
       "",
       {{"density", [](const Sample& s) { return double(s.pressure_iterations); }},
        {"divergence", [](const Sample& s) { return double(s.divergence_iterations); }}},
       false},
      {"Time step", "ms", {{"dt", [](const Sample& s) { return 1e3 * s.dt; }}}, false},
  };
  Plot cost{"Cost of a step", "ms", {{"step", [](const Sample& s) { return s.ms_step; }}}, false};
  for (std::size_t k = 0; k < pass_table().size(); ++k) {
    const std::string_view name = pass_table()[k].name;
    for (const auto& [pass, shown] :
         {std::pair("density_solve", "density"), {"divergence_solve", "divergence"}, {"neighbours", "neighbours"}}) {
      if (name != pass) continue;
      cost.series.push_back({shown, [k](const Sample& s) { return k < s.ms_pass.size() ? double(s.ms_pass[k]) : 0; }});
    }
  }
  plots.push_back(std::move(cost));
  return plots;
}

}  // namespace

void Interface::draw_plots() {
  static const std::vector<Plot> always = make_plots();
  if (button(plots_paused_ ? "Go on" : "Hold", "Hold the plots still; the run goes on")) {
    plots_paused_ = !plots_paused_;
    paused_samples_ = samples_;
  }
  mark("hold plots");
  const std::vector<Sample>& samples = plots_paused_ ? paused_samples_ : samples_;
  std::vector<Plot> plots{energy_plot(samples)};
  plots.insert(plots.end(), always.begin(), always.end());
  Plot budget = budget_plot(samples);  // comes with the first step, and last, so that nothing jumps
  if (!budget.series.empty()) plots.push_back(std::move(budget));
  for (const Plot& plot : plots) {
    const std::string label = plot.title + ".csv";
    same_line_if_fits(label.c_str());
    if (button(label.c_str(), "Write this plot's numbers to a file", !samples.empty())) {
      try {
        std::string kind = plot.title;
        for (char& c : kind) c = c == ' ' ? '_' : static_cast<char>(std::tolower(c));
        const std::string path = new_file(kind, "csv").string();
        AtomicFile file(path);
        file.write(plot_csv(plot, samples));
        file.commit();
        say("Wrote " + path);
      } catch (const std::exception& error) {
        say(error.what(), true);
      }
    }
  }
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const auto number = static_cast<float>(plots.size());
  const float width = std::max((all.x - gap * (number - 1)) / number, 14 * ImGui::GetFontSize());
  ImGui::BeginChild("plots", all, false, ImGuiWindowFlags_HorizontalScrollbar);
  const float height = ImGui::GetContentRegionAvail().y;
  for (const Plot& plot : plots) {
    if (&plot != plots.data()) ImGui::SameLine();
    draw_plot(plot, samples, width, height);
    mark("plot " + plot.title);
  }
  ImGui::EndChild();
}

}  // namespace curlew
