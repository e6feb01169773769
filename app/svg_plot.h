// Line plots as SVG files: panels side by side with axes, grid and one legend, and the command that made them.
// What lies outside the axes is cut off at the frame, in the numbers of the file and not by the viewer.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace curlew {

struct LineStyle {
  std::string colour = "#000000";
  std::string dash;  // as SVG has it, "8 4"; empty: solid
  double width = 2;
  bool markers = false;
};

// The k-th of eleven colours and dashes that people who cannot tell red from green tell apart too (after Okabe & Ito
// 2008 and Tol 2021); the first is black.
LineStyle line_style(std::size_t k);

struct PlotSeries {
  std::string name;          // series of the same name in several panels share an entry of the legend
  std::vector<double> x, y;  // where one is not finite, or not positive on a logarithmic axis, the line has a gap
  LineStyle style;
};

struct PlotAxis {
  std::string title;  // with its unit
  bool logarithmic = false;
  std::optional<double> min = {}, max = {};  // else from the data
};

struct PlotPanel {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
};

struct Plot {
  std::string title;
  std::vector<PlotPanel> panels;
  std::string command;  // in small print
};

std::string svg_text(const Plot& plot);

// The whole file or none; throws InputError.
void write_svg(const std::string& file, const Plot& plot);

}  // namespace curlew
