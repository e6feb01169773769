#include "app/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/svg.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

using namespace svg;

// Layout, in pixels. Readable where a page shows the picture at two thirds of its size.
constexpr double panel_width = 470, panel_height = 360, left = 88, top = 88, gap = 100, bottom = 92;
constexpr double legend_line = 27, legend_sample = 44;
constexpr const char* grid_colour = "#e3e3e3";

// An axis that knows its range: on a logarithmic one, in powers of ten.
struct Scale {
  bool logarithmic = false;
  double low = 0, high = 1, step = 1;
  double begin = 0, length = 1;  // pixels; y runs upwards, so its length is negative

  double inner(double value) const { return logarithmic ? std::log10(value) : value; }
  double pixel(double value) const { return begin + length * (inner(value) - low) / (high - low); }
};

// 1, 2 or 5 times a power of ten: some six ticks over the width.
double nice_step(double width) {
  const double raw = width / 6, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (raw <= factor * power * 1.0001) return factor * power;
  }
  return 10 * power;
}

Scale scale_of(const PlotAxis& axis, const std::vector<PlotSeries>& all, std::vector<double> PlotSeries::*values) {
  Scale scale;
  scale.logarithmic = axis.logarithmic;
  double low = INFINITY, high = -INFINITY;
  for (const PlotSeries& series : all) {
    for (const double value : series.*values) {
      const double v = scale.inner(value);
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
  }
  if (axis.min) low = scale.inner(*axis.min);
  if (axis.max) high = scale.inner(*axis.max);
  if (!std::isfinite(low) || !std::isfinite(high)) low = 0, high = 1;
  if (!(high - low > 1e-9 * std::max(1e-30, std::max(std::abs(low), std::abs(high))))) {
    const double half = scale.logarithmic ? 0.5 : std::max(1e-12, std::abs(low) / 2);
    low -= half, high += half;
  }
  scale.step = nice_step(high - low);
  if (scale.logarithmic) scale.step = std::max(1.0, std::round(scale.step));
  // A bound that nobody gave moves out to a tick; on a logarithmic axis to a fifth of a decade, which wastes less.
  const double unit = scale.logarithmic ? 0.2 : scale.step;
  scale.low = axis.min ? low : unit * std::floor(low / unit + 1e-9);
  scale.high = axis.max ? high : unit * std::ceil(high / unit - 1e-9);
  return scale;
}

struct Tick {
  double value;
  std::string label;  // empty: a grid line only
};

std::string raised(int power) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = power < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(power))) out += digits[c - '0'];
  return out;
}

std::string linear_label(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double rounded = std::abs(value) < 1e-9 * step ? 0 : value;
  return (rounded < 0 ? "−" : "") + format("%.*f", decimals, std::abs(rounded));
}

std::vector<Tick> linear_ticks(const Scale& scale) {
  std::vector<Tick> ticks;
  for (double k = std::ceil(scale.low / scale.step - 1e-6); k * scale.step <= scale.high + 1e-6 * scale.step; ++k) {
    ticks.push_back({k * scale.step, linear_label(k * scale.step, scale.step)});
  }
  return ticks;
}

// Powers of ten; where fewer than two fit, 2 and 5 times these too.
std::vector<Tick> logarithmic_ticks(const Scale& scale) {
  std::vector<Tick> ticks;
  const bool narrow = std::floor(scale.high + 1e-9) - std::ceil(scale.low - 1e-9) < 1;
  for (int power = static_cast<int>(std::floor(scale.low)); power <= scale.high + 1e-9; ++power) {
    for (int factor = 1; factor < 10; ++factor) {
      const double place = power + std::log10(factor);
      if (place < scale.low - 1e-9 || place > scale.high + 1e-9) continue;
      const double value = factor * std::pow(10, power);
      const bool decade = factor == 1 && power % static_cast<int>(scale.step) == 0;
      const bool labelled = narrow ? factor == 1 || factor == 2 || factor == 5 : decade;
      const std::string label = narrow ? format("%g", value) : "10" + raised(power);
      if (labelled || scale.step == 1) ticks.push_back({value, labelled ? label : ""});
    }
  }
  return ticks;
}

std::vector<Tick> ticks_of(const Scale& scale) {
  return scale.logarithmic ? logarithmic_ticks(scale) : linear_ticks(scale);
}

using Point = std::array<double, 2>;

// The part of a segment inside the frame (Liang & Barsky 1984); false where there is none.
bool clip(Point& a, Point& b, const Scale& x, const Scale& y) {
  const double low[2] = {x.begin, y.begin + y.length}, high[2] = {x.begin + x.length, y.begin};
  double enter = 0, leave = 1;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double d = b[axis] - a[axis];
    double t[2] = {(low[axis] - a[axis]) / d, (high[axis] - a[axis]) / d};
    if (d == 0) {
      if (a[axis] < low[axis] || a[axis] > high[axis]) return false;
      continue;
    }
    if (t[0] > t[1]) std::swap(t[0], t[1]);
    enter = std::max(enter, t[0]);
    leave = std::min(leave, t[1]);
  }
  if (enter > leave) return false;
  const Point from = a, d = {b[0] - a[0], b[1] - a[1]};
  a = {from[0] + enter * d[0], from[1] + enter * d[1]};
  b = {from[0] + leave * d[0], from[1] + leave * d[1]};
  return true;
}

std::string stroke(const LineStyle& style) {
  return " fill=\"none\" stroke=\"" + escaped(style.colour) + format("\" stroke-width=\"%g\"", style.width) +
         (style.dash.empty() ? "" : " stroke-dasharray=\"" + escaped(style.dash) + "\"");
}

std::string marker(Point p, const LineStyle& style) {
  return format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%g\" stroke=\"white\" fill=\"", p[0], p[1], 2.2 + style.width) +
         escaped(style.colour) + "\"/>\n";
}

std::string line_of(const PlotSeries& series, const Scale& x, const Scale& y) {
  std::string path, markers;
  Point last = {NAN, NAN}, pen = {NAN, NAN};
  for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
    const Point here = {x.pixel(series.x[k]), y.pixel(series.y[k])};
    Point a = last, b = here;
    last = here;
    const bool drawable = std::isfinite(here[0]) && std::isfinite(here[1]);
    if (Point p = here, q = here; drawable && series.style.markers && clip(p, q, x, y))
      markers += marker(p, series.style);
    if (!drawable || !std::isfinite(a[0]) || !std::isfinite(a[1]) || !clip(a, b, x, y)) continue;
    if (a != pen) path += format("M%.1f %.1f", a[0], a[1]);
    path += format("L%.1f %.1f", b[0], b[1]);
    pen = b;
  }
  const std::string line =
      path.empty() ? "" : "<path stroke-linejoin=\"round\"" + stroke(series.style) + " d=\"" + path + "\"/>\n";
  return line + markers;
}

std::string grid_and_labels(const PlotPanel& panel, const Scale& x, const Scale& y) {
  std::string lines, labels;
  const double right = x.begin + x.length, upper = y.begin + y.length;
  for (const Tick& tick : ticks_of(x)) {
    const double at = x.pixel(tick.value);
    lines += format("M%.1f %.1fV%.1f", at, y.begin, upper);
    labels += text_at(at, y.begin + 24, tick.label, "middle");
  }
  double widest = 0;
  for (const Tick& tick : ticks_of(y)) {
    const double at = y.pixel(tick.value);
    widest = std::max(widest, text_width(tick.label));
    lines += format("M%.1f %.1fH%.1f", x.begin, at, right);
    labels += text_at(x.begin - 9, at + 5.5, tick.label, "end");
  }
  const double middle = x.begin + x.length / 2, height = y.begin + y.length / 2, beside = x.begin - widest - 26;
  labels += text_at(middle, y.begin + 50, panel.x.title, "middle");
  labels += text_at(beside, height, panel.y.title, "middle", text_size,
                    format(" transform=\"rotate(-90 %.1f %.1f)\"", beside, height).c_str());
  labels += text_at(middle, upper - 14, panel.title, "middle", text_size, " font-weight=\"bold\"");
  return "<path stroke=\"" + std::string(grid_colour) + "\" fill=\"none\" d=\"" + lines + "\"/>\n" + labels;
}

std::string panel_text(const PlotPanel& panel, double begin) {
  Scale x = scale_of(panel.x, panel.series, &PlotSeries::x), y = scale_of(panel.y, panel.series, &PlotSeries::y);
  x.begin = begin, x.length = panel_width;
  y.begin = top + panel_height, y.length = -panel_height;
  std::string out = grid_and_labels(panel, x, y);
  for (const PlotSeries& series : panel.series) out += line_of(series, x, y);
  return out + format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"%s\"/>\n",
                      begin, top, panel_width, panel_height, ink);
}

std::vector<const PlotSeries*> legend_entries(const Plot& plot) {
  std::vector<const PlotSeries*> entries;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotSeries& series : panel.series) {
      const auto same = [&](const PlotSeries* other) { return other->name == series.name; };
      if (!series.name.empty() && std::none_of(entries.begin(), entries.end(), same)) entries.push_back(&series);
    }
  }
  return entries;
}

std::string legend_text(const std::vector<const PlotSeries*>& entries, double begin) {
  std::string out;
  double y = top + 12;
  for (const PlotSeries* series : entries) {
    out += format("<path d=\"M%.1f %.1fh%g\"", begin, y, legend_sample) + stroke(series->style) + "/>\n";
    if (series->style.markers) out += marker({begin + legend_sample / 2, y}, series->style);
    out += text_at(begin + legend_sample + 9, y + 5.5, series->name, "start");
    y += legend_line;
  }
  return out;
}

}  // namespace

LineStyle line_style(std::size_t k) {
  static const LineStyle styles[] = {
      {"#000000", "", 2.6},  {"#0072b2", "", 2},        {"#56b4e9", "", 2},           {"#009e73", "", 2},
      {"#332288", "", 2},    {"#e69f00", "9 4", 2},     {"#d55e00", "9 4", 2},        {"#cc79a7", "5 3", 2},
      {"#882255", "5 3", 2}, {"#7a5c1e", "2 2.5", 2.2}, {"#7f7f7f", "12 3 3 3", 2.2},
  };
  return styles[k % std::size(styles)];
}

std::string svg_text(const Plot& plot) {
  const auto entries = legend_entries(plot);
  double longest = 0;
  for (const PlotSeries* series : entries) longest = std::max(longest, text_width(series->name));
  const double panels = static_cast<double>(plot.panels.size());
  const double end_of_panels = left + panels * panel_width + std::max(0.0, panels - 1) * gap;
  const double legend = entries.empty() ? 0 : legend_sample + 33 + longest;
  const double width = end_of_panels + 24 + legend;
  const double legend_end = top + legend_line * static_cast<double>(entries.size());
  const std::vector<std::string> small_print = wrapped(plot.command, width - 2 * left);
  const double height =
      std::max(top + panel_height, legend_end) + bottom + small_line * static_cast<double>(small_print.size() - 1);
  std::string out = begin_picture(width, height);
  out += text_at(left, 36, plot.title, "start", 20, " font-weight=\"bold\"");
  for (std::size_t k = 0; k < plot.panels.size(); ++k) {
    out += panel_text(plot.panels[k], left + static_cast<double>(k) * (panel_width + gap));
  }
  out += legend_text(entries, end_of_panels + 24);
  return out + small_print_text(small_print, left, height) + "</svg>\n";
}

void write_svg(const std::string& file, const Plot& plot) {
  AtomicFile out(file);
  out.write(svg_text(plot));
  out.commit();
}

}  // namespace curlew
