// Pictures of where something is well and where it is not: panels of coloured cells over two axes of given values, as
// SVG files. A cell has a word and a number beside its colour, so that it reads in grey too.
#pragma once

#include <string>
#include <vector>

namespace curlew {

// What a cell can be.
struct HeatKind {
  std::string colour, ink;
};

struct HeatCell {
  int kind = -1;  // place in HeatMap::kinds; below 0: empty
  std::string word, number;
  bool marked = false;  // with a corner
};

struct HeatAxis {
  std::string title;  // with symbol and unit; may be empty
  std::vector<std::string> labels;
  int limit = -1;  // a bar runs beside the axis from this value on; below 0: none
};

struct HeatPanel {
  std::string title;
  HeatAxis x, y;                // y upwards
  std::vector<HeatCell> cells;  // row by row from the lowest
};

struct HeatMap {
  std::string title;
  std::size_t columns = 2;  // of panels
  std::vector<HeatPanel> panels;
  std::vector<HeatKind> kinds;
  std::vector<std::string> notes;  // sentences below
  std::string command;             // in small print
};

std::string svg_text(const HeatMap& map);

// The whole file or none; throws InputError.
void write_svg(const std::string& file, const HeatMap& map);

}  // namespace curlew
