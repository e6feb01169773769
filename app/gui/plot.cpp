#include "app/gui/plot.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/ticks.h"
#include "sim/core/params.h"

namespace curlew {
namespace {

// Told apart by eyes that do not tell red from green: Okabe & Ito (2008).
constexpr ImU32 colours[] = {IM_COL32(0, 114, 178, 255),   IM_COL32(230, 159, 0, 255), IM_COL32(0, 158, 115, 255),
                             IM_COL32(204, 121, 167, 255), IM_COL32(213, 94, 0, 255),  IM_COL32(86, 180, 233, 255)};

ImU32 colour_of(std::size_t k) { return colours[k % std::size(colours)]; }

struct Axes {
  ImVec2 low, high;  // corners of the drawing, in pixels: left top, right bottom
  double t0, t1, y0, y1;
  bool logarithmic;

  float x(double t) const { return low.x + static_cast<float>((t - t0) / (t1 - t0)) * (high.x - low.x); }
  float y(double v) const {
    const double at = logarithmic ? std::log10(std::max(v, 1e-300)) : v;
    return high.y - static_cast<float>((std::clamp(at, y0, y1) - y0) / (y1 - y0)) * (high.y - low.y);
  }
};

// The span of all series; in decades where the axis is logarithmic.
std::pair<double, double> value_range(const Plot& plot, std::span<const Sample> samples) {
  double least = INFINITY, most = -INFINITY;
  for (const Series& series : plot.series) {
    for (const Sample& sample : samples) {
      double v = series.value(sample);
      if (plot.logarithmic) v = v > 0 ? std::log10(v) : NAN;
      if (!std::isfinite(v)) continue;
      least = std::min(least, v);
      most = std::max(most, v);
    }
  }
  if (least > most) return {0, 1};
  if (plot.logarithmic)
    return {std::floor(std::max(least, most - 6)), std::max(std::ceil(most), std::floor(least) + 1)};
  if (least > 0 && least < 0.6 * most) least = 0;
  const double margin = most > least ? 0.05 * (most - least) : std::max(1e-12, 0.05 * std::abs(most));
  return {least == 0 ? 0 : least - margin, most + margin};
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

void draw_grid(ImDrawList& list, const Axes& axes, float line_height) {
  const ImU32 grid = ImGui::GetColorU32(ImGuiCol_Text, 0.13f), ink = ImGui::GetColorU32(ImGuiCol_Text, 0.75f);
  const int rows = std::max(2, static_cast<int>((axes.high.y - axes.low.y) / (2.2f * line_height)));
  const auto label = [&](float y, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddLine({axes.low.x, y}, {axes.high.x, y}, grid);
    list.AddText({axes.low.x - size.x - 5, y - 0.5f * size.y}, ink, text.c_str());
  };
  if (axes.logarithmic) {
    const int step = std::max(1, static_cast<int>(std::ceil((axes.y1 - axes.y0) / rows)));
    for (int decade = static_cast<int>(axes.y0); decade <= axes.y1; decade += step) {
      label(axes.y(std::pow(10.0, decade)), "1e" + std::to_string(decade));
    }
  } else {
    for (const double v : round_ticks({axes.y0, axes.y1}, rows).at) label(axes.y(v), short_number(v));
  }
  const int columns = std::max(3, static_cast<int>((axes.high.x - axes.low.x) / (4 * line_height)));
  for (const double t : round_ticks({axes.t0, axes.t1}, columns).at) {
    const std::string text = short_number(t);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    if (axes.x(t) + 0.5f * size.x > axes.high.x - line_height) continue;  // the unit stands there
    list.AddLine({axes.x(t), axes.low.y}, {axes.x(t), axes.high.y}, grid);
    list.AddText({axes.x(t) - 0.5f * size.x, axes.high.y + 3}, ink, text.c_str());
  }
  list.AddText({axes.high.x - ImGui::CalcTextSize("s").x, axes.high.y + 3}, ink, "s");
}

// One point a pixel column and extreme: nothing that stands out is lost, and long runs draw as fast as short ones.
void draw_line(ImDrawList& list, const Axes& axes, const Series& series, std::span<const Sample> samples,
               ImU32 colour) {
  std::vector<ImVec2> points;
  int column = -1;
  double least = 0, most = 0;
  const auto flush = [&] {
    if (column < 0) return;
    const float x = axes.low.x + static_cast<float>(column);
    points.push_back({x, axes.y(most)});
    if (least != most) points.push_back({x, axes.y(least)});
  };
  for (const Sample& sample : samples) {
    const double v = series.value(sample);
    if (!std::isfinite(v)) continue;
    const int here = static_cast<int>(axes.x(sample.time) - axes.low.x);
    if (here != column) {
      flush();
      column = here;
      least = most = v;
    }
    least = std::min(least, v);
    most = std::max(most, v);
  }
  flush();
  list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, 1.5f);
}

void draw_values_under_mouse(ImDrawList& list, const Plot& plot, const Axes& axes, std::span<const Sample> samples) {
  const double t =
      axes.t0 +
      static_cast<double>((ImGui::GetIO().MousePos.x - axes.low.x) / (axes.high.x - axes.low.x)) * (axes.t1 - axes.t0);
  const auto after = std::lower_bound(samples.begin(), samples.end(), t,
                                      [](const Sample& sample, double time) { return sample.time < time; });
  const Sample& sample = after == samples.end() ? samples.back() : *after;
  const float x = axes.x(sample.time);
  list.AddLine({x, axes.low.y}, {x, axes.high.y}, ImGui::GetColorU32(ImGuiCol_Text, 0.5f));
  ImGui::BeginTooltip();
  ImGui::Text("%s s, step %lld", short_number(sample.time).c_str(), static_cast<long long>(sample.step));
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const double v = plot.series[k].value(sample);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colour_of(k)), "%s", plot.series[k].name.c_str());
    ImGui::SameLine();
    if (std::isfinite(v)) {
      ImGui::Text("%s %s", short_number(v).c_str(), plot.unit.c_str());
    } else {
      ImGui::TextUnformatted("none");
    }
    if (std::isfinite(v)) list.AddCircleFilled({x, axes.y(v)}, 3, colour_of(k));
  }
  ImGui::EndTooltip();
}

}  // namespace

namespace {

// Returns the height it took.
float draw_legend(ImDrawList& list, const Plot& plot, ImVec2 at, float width) {
  if (plot.series.size() < 2) return 0;
  const float line = ImGui::GetTextLineHeight(), left = at.x, top = at.y;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const float wide = ImGui::CalcTextSize(plot.series[k].name.c_str()).x;
    if (at.x > left && at.x + 0.8f * line + wide > left + width) at = {left, at.y + line};
    list.AddLine({at.x, at.y + 0.55f * line}, {at.x + 0.5f * line, at.y + 0.55f * line}, colour_of(k), 2);
    list.AddText({at.x + 0.7f * line, at.y}, ImGui::GetColorU32(ImGuiCol_Text, 0.8f), plot.series[k].name.c_str());
    at.x += wide + 1.3f * line;
  }
  return at.y + line - top;
}

}  // namespace

void draw_plot(const Plot& plot, std::span<const Sample> samples, float width, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight();
  const std::string title = plot.title + (plot.unit.empty() ? "" : " (" + plot.unit + ")");
  list.AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), title.c_str());
  const float legend = draw_legend(list, plot, {corner.x, corner.y + 1.2f * line}, width);
  ImGui::InvisibleButton(plot.title.c_str(), {std::max(1.0f, width), std::max(1.0f, height)});
  const bool hovered = ImGui::IsItemHovered();
  const auto [y0, y1] = value_range(plot, samples);
  const double t0 = samples.empty() ? 0 : samples.front().time, t1 = samples.empty() ? 1 : samples.back().time;
  const Axes axes{{corner.x + 3.9f * line, corner.y + 1.6f * line + legend},
                  {corner.x + width - 0.5f * line, corner.y + height - 1.5f * line},
                  t0,
                  t1 > t0 ? t1 : t0 + 1,
                  y0,
                  y1,
                  plot.logarithmic};
  draw_grid(list, axes, line);
  list.PushClipRect(axes.low, axes.high, true);
  for (std::size_t k = 0; k < plot.series.size(); ++k) draw_line(list, axes, plot.series[k], samples, colour_of(k));
  list.PopClipRect();
  if (hovered && !samples.empty()) draw_values_under_mouse(list, plot, axes, samples);
}

Plot budget_plot(std::span<const Sample> samples) {
  Plot plot{"Energy budget", "J", {}, false};
  if (samples.empty()) return plot;
  for (const auto& [name, newest] : samples.back().budget) {
    plot.series.push_back({std::string(name), [name = name](const Sample& sample) {
                             for (const NamedValue& entry : sample.budget) {
                               if (entry.name == name) return entry.value;
                             }
                             return std::nan("");
                           }});
  }
  return plot;
}

std::string plot_csv(const Plot& plot, std::span<const Sample> samples) {
  std::string text = "step,time (s)";
  for (const Series& series : plot.series)
    text += "," + series.name + (plot.unit.empty() ? "" : " (" + plot.unit + ")");
  text += "\n";
  for (const Sample& sample : samples) {
    text += std::to_string(sample.step) + "," + number_text(sample.time);
    for (const Series& series : plot.series) {
      const double v = series.value(sample);
      text += "," + (std::isfinite(v) ? number_text(v) : "");
    }
    text += "\n";
  }
  return text;
}

}  // namespace curlew
