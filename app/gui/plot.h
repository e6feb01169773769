// Lines over time in a Dear ImGui window: axes with round numbers and units, a legend, and the values under the mouse.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/session.h"

namespace curlew {

struct Series {
  std::string name;                            // "kinetic"
  std::function<double(const Sample&)> value;  // in the plot's unit
};

struct Plot {
  std::string title, unit;  // "Energy", "J"
  std::vector<Series> series;
  bool logarithmic = false;
};

// One curve for each name in the newest sample's budget, in its order; before a name comes first its curve has a gap.
// No curves where there is no budget.
Plot budget_plot(std::span<const Sample> samples);

// Draws into the space of that size at the cursor.
void draw_plot(const Plot& plot, std::span<const Sample> samples, float width, float height);

// The same numbers as text: time and one column a series, with units in the header.
std::string plot_csv(const Plot& plot, std::span<const Sample> samples);

}  // namespace curlew
