#include "app/contour_plot.h"

#include <algorithm>
#include <array>
#include <map>

#include "app/svg.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

using namespace svg;

// Layout, in pixels.
constexpr double side = 470, margin = 28, head = 64, panel_head = 34, gap = 36, note_size = 14;
constexpr const char *negative_colour = "#2b6a99", *positive_colour = "#c1440e";

// An edge of the grid, which a line crosses once at most: 2 node, and 1 more for the one upwards.
using Edge = std::size_t;
using Links = std::map<Edge, std::vector<Edge>>;

Vec3d crossing(const NodeField& field, Edge edge, double level) {
  const std::size_t row = field.across + 1, node = edge / 2, next = node + (edge % 2 == 0 ? 1 : row);
  const double a = field.values[node] - level, b = field.values[next] - level, share = a / (a - b);
  const Vec3d from{static_cast<double>(node % row), static_cast<double>(node / row), 0};
  const Vec3d along = edge % 2 == 0 ? Vec3d{share, 0, 0} : Vec3d{0, share, 0};
  return 1 / static_cast<double>(field.across) * (from + along);
}

// Which edges of a cell a line joins (marching squares, Lorensen & Cline 1987 in 2D); at a saddle by the mean.
void link_cell(const NodeField& field, std::size_t i, std::size_t j, double level, Links& links) {
  const std::size_t row = field.across + 1, node = j * row + i;
  const std::array<std::size_t, 4> corners = {node, node + 1, node + 1 + row, node + row};
  const std::array<Edge, 4> edges = {2 * node, 2 * (node + 1) + 1, 2 * (node + row), 2 * node + 1};
  const auto above = [&](std::size_t k) { return field.values[corners[k % 4]] >= level; };
  std::vector<std::size_t> cut;
  double mean = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    mean += field.values[corners[k]] / 4;
    if (above(k) != above(k + 1)) cut.push_back(k);
  }
  if (cut.empty()) return;
  if (cut.size() == 4 && (mean >= level) == above(0)) std::rotate(cut.begin(), cut.begin() + 1, cut.end());
  if (cut.size() == 4) std::rotate(cut.begin(), cut.begin() + 3, cut.end());
  for (std::size_t k = 0; k + 1 < cut.size(); k += 2) {
    links[edges[cut[k]]].push_back(edges[cut[k + 1]]);
    links[edges[cut[k + 1]]].push_back(edges[cut[k]]);
  }
}

// Takes a chain out of the links, from one end on.
std::vector<Edge> take_chain(Links& links, Edge from) {
  std::vector<Edge> chain = {from};
  for (auto here = links.find(from); here != links.end() && !here->second.empty();) {
    const Edge next = here->second.back();
    here->second.pop_back();
    const auto there = links.find(next);
    there->second.erase(std::find(there->second.begin(), there->second.end(), chain.back()));
    chain.push_back(next);
    here = there;
  }
  return chain;
}

std::string panel_text(const ContourPanel& panel, const std::vector<double>& levels, double left, double top) {
  const auto x = [&](double at) { return left + side * at; };
  const auto y = [&](double at) { return top + side * (1 - at); };
  std::string out = text_at(left + side / 2, top - 12, panel.title, "middle", text_size, " font-weight=\"bold\"");
  for (const double level : levels) {
    std::string path;
    for (const auto& line : contour_lines(panel.field, level)) {
      for (std::size_t k = 0; k < line.size(); ++k) {
        path += format("%s%.1f %.1f", k == 0 ? "M" : "L", x(line[k].x), y(line[k].y));
      }
    }
    if (path.empty()) continue;
    out += format("<path fill=\"none\" stroke-width=\"1.1\" stroke=\"%s\" d=\"",
                  level > 0 ? positive_colour : negative_colour) +
           path + "\"/>\n";
  }
  for (const ContourMark& mark : panel.marks) {
    out += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>\n", x(mark.x), y(mark.y));
    out += text_at(x(mark.x) + 6, y(mark.y) - 6, mark.name, "start", note_size,
                   " stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\"");
  }
  return out + format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"%s\"/>\n", left,
                      top, side, side, ink);
}

}  // namespace

std::vector<std::vector<Vec3d>> contour_lines(const NodeField& field, double level) {
  Links links;
  for (std::size_t j = 0; j < field.across; ++j) {
    for (std::size_t i = 0; i < field.across; ++i) link_cell(field, i, j, level, links);
  }
  std::vector<std::vector<Vec3d>> lines;
  for (const std::size_t ends : {1, 2}) {  // open lines first, so that they are not begun in their middle
    for (const auto& [edge, others] : links) {
      if (others.size() != ends) continue;
      std::vector<Vec3d>& line = lines.emplace_back();
      for (const Edge e : take_chain(links, edge)) line.push_back(crossing(field, e, level));
    }
  }
  return lines;
}

std::string svg_text(const ContourPlot& plot) {
  const double panels = static_cast<double>(plot.panels.size());
  const double width =
      std::max(2 * margin + panels * side + (panels - 1) * gap, 2 * margin + text_width(plot.title, 22));
  constexpr double height = head + panel_head;
  double left = margin;
  std::string body;
  for (const ContourPanel& panel : plot.panels) {
    body += panel_text(panel, plot.levels, left, height);
    left += side + gap;
  }
  return page_text({plot.title, plot.notes, plot.command, width, margin, height + side + 12}, body);
}

void write_svg(const std::string& file, const ContourPlot& plot) {
  AtomicFile out(file);
  out.write(svg_text(plot));
  out.commit();
}

}  // namespace curlew
