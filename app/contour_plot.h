// Contour lines of fields on the unit square as SVG files: panels side by side, lines of each sign in a colour of their
// own, marked places, and the command that made them.
#pragma once

#include <string>
#include <vector>

#include "app/cavity_field.h"

namespace curlew {

struct ContourMark {
  std::string name;
  double x = 0, y = 0;
};

struct ContourPanel {
  std::string title;
  NodeField field;
  std::vector<ContourMark> marks;
};

struct ContourPlot {
  std::string title;
  std::vector<double> levels;
  std::vector<ContourPanel> panels;
  std::vector<std::string> notes;  // sentences below
  std::string command;             // in small print
};

// The lines on which the field has a value, linear between nodes, as chains of points; a closed one ends where it
// begins.
std::vector<std::vector<Vec3d>> contour_lines(const NodeField& field, double level);

std::string svg_text(const ContourPlot& plot);

// The whole file or none; throws InputError.
void write_svg(const std::string& file, const ContourPlot& plot);

}  // namespace curlew
