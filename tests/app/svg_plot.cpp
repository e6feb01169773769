// The plots of the benches: well-formed, with all that a reader needs, and nothing drawn outside the axes.
#include "app/svg_plot.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <regex>
#include <set>

#include "tests/app/svg_text.h"

using namespace curlew;
using namespace curlew::test;

namespace {

struct Corner {
  double x, y;
  bool lifted;  // the pen was lifted before
};

// The corners of the data line in a colour; the line of the legend is drawn with h.
std::vector<Corner> corners(const std::string& svg, const std::string& colour) {
  const std::regex line("<path stroke-linejoin[^>]*stroke=\"" + colour + "\"[^>]* d=\"([^\"]*)\"");
  const std::regex corner("([ML])([-0-9.]+) ([-0-9.]+)");
  std::vector<Corner> all;
  for (std::sregex_iterator path(svg.begin(), svg.end(), line), end; path != end; ++path) {
    const std::string d = (*path)[1];
    for (std::sregex_iterator c(d.begin(), d.end(), corner); c != end; ++c) {
      all.push_back({std::stod((*c)[2]), std::stod((*c)[3]), (*c)[1] == "M"});
    }
  }
  return all;
}

// The frame of the only panel.
struct Frame {
  double x, y, width, height;
};
Frame frame(const std::string& svg) {
  std::smatch found;
  REQUIRE(std::regex_search(
      svg, found, std::regex("<rect x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\" height=\"([0-9.]+)\"")));
  return {std::stod(found[1]), std::stod(found[2]), std::stod(found[3]), std::stod(found[4])};
}

const LineStyle red = {"#ff0000", "", 2, false}, green = {"#00ff00", "4 2", 2, true};

}  // namespace

TEST_CASE("a plot is well-formed and says what it shows") {
  Plot plot{
      "Up & down", {{"Left", {"time (s)"}, {"height (m)"}, {}}, {"Right", {"time (s)"}, {"speed (m/s)"}, {}}}, {}};
  for (PlotPanel& panel : plot.panels) {
    panel.series = {{"a < b", {0, 1, 2}, {0, 1, 4}, red}, {"plain", {0, 1, 2}, {3, 3, 3}, green}};
  }
  plot.command = "curlew bench \"a\" <b>";
  const std::string svg = svg_text(plot);
  CHECK(well_formed(svg));
  CHECK_FALSE(well_formed("<svg><g></svg>"));
  CHECK_FALSE(well_formed("<svg>a & b</svg>"));
  for (const char* words : {">Up &amp; down<", ">Left<", ">Right<", ">time (s)<", ">height (m)<", ">speed (m/s)<",
                            ">curlew bench &quot;a&quot; &lt;b&gt;<", ">0.5<", ">2.0<", ">4<"}) {
    INFO(words);
    CHECK(svg.find(words) != std::string::npos);
  }
  CHECK(count(svg, ">a &lt; b<") == 1);  // one legend for both panels
  CHECK(count(svg, ">plain<") == 1);
  CHECK(count(svg, "<circle") == 3 * 2 + 1);  // markers, and that of the legend
  CHECK(count(svg, "stroke-dasharray=\"4 2\"") == 3);
}

TEST_CASE("lines end at the axes") {
  const PlotPanel panel{
      "", {"x", false, 0, 10}, {"y", false, 0, 1}, {{"a", {-5, 5, 15, 15, 5, 5}, {0.5, 0.5, 0.5, 5, 5, -5}, red}}};
  const std::string svg = svg_text({"", {panel}, ""});
  const Frame f = frame(svg);
  const auto line = corners(svg, "#ff0000");
  for (const Corner& c : line) {
    CHECK(c.x >= f.x - 0.06);
    CHECK(c.x <= f.x + f.width + 0.06);
    CHECK(c.y >= f.y - 0.06);
    CHECK(c.y <= f.y + f.height + 0.06);
  }
  // In from the left to the right edge, then out of sight, then down through the middle.
  REQUIRE(line.size() == 5);
  CHECK(line[0].x == Approx(f.x).margin(0.06));
  CHECK(line[2].x == Approx(f.x + f.width).margin(0.06));
  CHECK(line[2].y == Approx(f.y + f.height / 2).margin(0.06));
  CHECK(line[3].lifted);
  CHECK(line[3].y == Approx(f.y).margin(0.06));
  CHECK(line[4].x == Approx(f.x + f.width / 2).margin(0.06));
  CHECK(line[4].y == Approx(f.y + f.height).margin(0.06));
}

TEST_CASE("logarithmic axes run in powers of ten and leave out what has no logarithm") {
  const PlotPanel panel{
      "", {"time (ms)", true}, {"error", true}, {{"a", {1, 10, 100, 1000, 10000}, {1e-1, 1e-2, 0, 1e-4, 1e-5}, red}}};
  const std::string svg = svg_text({"", {panel}, ""});
  for (const char* words : {">10⁰<", ">10⁴<", ">10⁻¹<", ">10⁻⁵<"}) CHECK(svg.find(words) != std::string::npos);
  const Frame f = frame(svg);
  const auto line = corners(svg, "#ff0000");
  REQUIRE(line.size() == 4);  // a gap in the middle
  CHECK(line[2].lifted);
  CHECK(line[1].x - line[0].x == Approx(f.width / 4).margin(0.11));
  CHECK(line[1].y - line[0].y == Approx(f.height / 4).margin(0.11));
}

TEST_CASE("empty and constant data make a plot too") {
  const double nan = std::nan("");
  for (const PlotSeries& series : {PlotSeries{"a", {}, {}, red}, PlotSeries{"a", {1}, {2}, green},
                                   PlotSeries{"a", {0, 1}, {7, 7}, red}, PlotSeries{"a", {0, 1}, {nan, nan}, green}}) {
    for (const bool logarithmic : {false, true}) {
      const std::string svg = svg_text({"t", {{"", {"x", logarithmic}, {"y", logarithmic}, {series}}}, "c"});
      CHECK(well_formed(svg));
      CHECK(svg.find("nan") == std::string::npos);
      CHECK(svg.find("inf") == std::string::npos);
      CHECK(svg.size() < 20000);
    }
  }
}

TEST_CASE("eleven line styles differ, and a long command is broken into lines") {
  std::set<std::string> colours;
  for (std::size_t k = 0; k < 11; ++k) colours.insert(line_style(k).colour);
  CHECK(colours.size() == 11);
  std::string command = "curlew bench energy --methods";
  for (int k = 0; k < 40; ++k) command += " vr1.0" + std::to_string(k);
  const std::string svg = svg_text({"", {{"", {"x"}, {"y"}, {}}}, command});
  CHECK(count(svg, "font-family=\"monospace\"") > 3);
  CHECK(svg.find("vr1.039</text>") != std::string::npos);
}
