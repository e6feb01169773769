#include "app/heat_map.h"

#include <algorithm>

#include "app/svg.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

using namespace svg;

// Layout, in pixels.
constexpr double cell_width = 88, cell_height = 42, edge = 28, head = 64, panel_head = 34, foot = 62, gap = 44,
                 word_size = 14;
constexpr const char* limit_colour = "#b2182b";

struct Size {
  double width = 0, height = 0;
};

double label_width(const HeatPanel& panel) {
  double widest = 0;
  for (const std::string& label : panel.y.labels) widest = std::max(widest, text_width(label));
  return widest + 20 + (panel.y.title.empty() ? 0 : 26);
}

Size cells_size(const HeatPanel& panel) {
  return {cell_width * static_cast<double>(panel.x.labels.size()),
          cell_height * static_cast<double>(panel.y.labels.size())};
}

std::string cell_text(const HeatCell& cell, const std::vector<HeatKind>& kinds, double x, double y) {
  const auto kind = static_cast<std::size_t>(cell.kind);
  if (cell.kind < 0 || kind >= kinds.size()) return "";
  std::string out = format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%g\" height=\"%g\" stroke=\"white\" fill=\"", x, y,
                           cell_width, cell_height) +
                    escaped(kinds[kind].colour) + "\"/>\n";
  const std::string colour = " fill=\"" + escaped(kinds[kind].ink) + "\"";
  const double middle = x + cell_width / 2;
  out += text_at(middle, y + 18, cell.word, "middle", word_size, (colour + " font-weight=\"bold\"").c_str());
  out += text_at(middle, y + 35, cell.number, "middle", word_size, colour.c_str());
  if (cell.marked) out += format("<path d=\"M%.1f %.1fh-12l12 12z\"", x + cell_width, y) + colour + "/>\n";
  return out;
}

std::string bar(double x, double y, double width, double height) {
  return format("<rect class=\"limit\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", x, y,
                width, height, limit_colour);
}

std::string axes_text(const HeatPanel& panel, double x, double y) {
  const Size size = cells_size(panel);
  const double low = y + size.height;
  std::string out;
  for (std::size_t k = 0; k < panel.x.labels.size(); ++k) {
    out += text_at(x + cell_width * (static_cast<double>(k) + 0.5), low + 23, panel.x.labels[k], "middle");
  }
  for (std::size_t k = 0; k < panel.y.labels.size(); ++k) {
    out += text_at(x - 11, low - cell_height * (static_cast<double>(k) + 0.5) + 5.5, panel.y.labels[k], "end");
  }
  if (panel.x.limit >= 0) {
    const double from = cell_width * panel.x.limit;
    out += bar(x + from, low + 2, size.width - from, 4);
  }
  if (panel.y.limit >= 0) {
    const double from = cell_height * panel.y.limit;
    out += bar(x - 6, y, 4, size.height - from);
  }
  out += text_at(x + size.width / 2, low + 46, panel.x.title, "middle");
  const double beside = x - label_width(panel) + 16, middle = y + size.height / 2;
  if (!panel.y.title.empty()) {
    out += text_at(beside, middle, panel.y.title, "middle", text_size,
                   format(" transform=\"rotate(-90 %.1f %.1f)\"", beside, middle).c_str());
  }
  return out + text_at(x + size.width / 2, y - 12, panel.title, "middle", text_size, " font-weight=\"bold\"");
}

// With the left upper corner of its cells there.
std::string panel_text(const HeatPanel& panel, const std::vector<HeatKind>& kinds, double x, double y) {
  const Size size = cells_size(panel);
  std::string out = format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#f2f2f2\"/>\n", x, y,
                           size.width, size.height);
  const std::size_t columns = panel.x.labels.size();
  for (std::size_t k = 0; k < panel.cells.size() && columns > 0; ++k) {
    const double column = static_cast<double>(k % columns), row = static_cast<double>(k / columns);
    out += cell_text(panel.cells[k], kinds, x + cell_width * column, y + size.height - cell_height * (row + 1));
  }
  return out + axes_text(panel, x, y);
}

}  // namespace

std::string svg_text(const HeatMap& map) {
  const std::size_t columns = std::max<std::size_t>(1, map.columns);
  const std::size_t rows = (map.panels.size() + columns - 1) / columns;
  std::vector<Size> column_of(columns), row_of(rows);  // labels and cells; heights of rows
  std::vector<double> labels(columns);
  for (std::size_t k = 0; k < map.panels.size(); ++k) {
    const Size size = cells_size(map.panels[k]);
    Size& column = column_of[k % columns];
    // A title may be wider than its cells.
    const double text = std::max(text_width(map.panels[k].title), text_width(map.panels[k].x.title));
    column.width = std::max({column.width, size.width, text});
    labels[k % columns] = std::max(labels[k % columns], label_width(map.panels[k]));
    row_of[k / columns].height = std::max(row_of[k / columns].height, size.height);
  }
  double width = edge, height = head;
  for (std::size_t k = 0; k < columns; ++k) width += labels[k] + column_of[k].width + (k + 1 < columns ? gap : edge);
  width = std::max(width, 2 * edge + text_width(map.title, 20) * 1.1);
  std::string body;
  for (std::size_t row = 0; row < rows; ++row) {
    double x = edge;
    for (std::size_t k = row * columns; k < std::min(map.panels.size(), (row + 1) * columns); ++k) {
      x += labels[k % columns];
      body += panel_text(map.panels[k], map.kinds, x, height + panel_head);
      x += column_of[k % columns].width + gap;
    }
    height += panel_head + row_of[row].height + foot;
  }
  return page_text({map.title, map.notes, map.command, width, edge, height}, body);
}

void write_svg(const std::string& file, const HeatMap& map) {
  AtomicFile out(file);
  out.write(svg_text(map));
  out.commit();
}

}  // namespace curlew
