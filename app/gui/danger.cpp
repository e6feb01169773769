#include "app/gui/danger.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/gui/style.h"

namespace curlew {
namespace {

// Vorticity confinement has none: the papers name no value from which it is too much (Bender et al. 2018, section 2,
// only say that there is one).
constexpr Danger table[] = {
    {"vorticity_refinement.alpha", 1.3, 1,
     "gains energy and does not calm down, 1.2 still does (Liu et al. 2020, section 5.1 and Fig. 7)."},
    {"micropolar.nu_t", 0.2, 1,
     "gains energy and does not calm down, 0.1 still does (Liu et al. 2020, section 5.1 and Fig. 7)."},
    {"micropolar.nu_t", 0.4, 2, "tends to get unrealistic (Bender et al. 2018, section 7 and Fig. 7)."},
};

// As Dear ImGui places the middle of the grab.
float place_on_slider(const ParameterRow& row, double value, float low, float high) {
  const double share = logarithmic(row) ? std::log(value / row.slider_min) / std::log(row.slider_max / row.slider_min)
                                        : (value - row.slider_min) / (row.slider_max - row.slider_min);
  const float margin = 2 + 0.5f * ImGui::GetStyle().GrabMinSize;
  return low + margin + static_cast<float>(std::clamp(share, 0.0, 1.0)) * (high - low - 2 * margin);
}

bool is_dark() { return ImGui::GetStyleColorVec4(ImGuiCol_WindowBg).x < 0.5f; }

// Orange and red of Okabe & Ito (2008), weak enough for the number on the slider.
ImVec4 colour_of(int level, float opacity) {
  const ImVec4 light[] = {{0.90f, 0.55f, 0, opacity}, {0.84f, 0.25f, 0, opacity}};
  const ImVec4 dark[] = {{0.95f, 0.65f, 0.15f, opacity}, {1, 0.38f, 0.20f, opacity}};
  return (is_dark() ? dark : light)[level - 1];
}

}  // namespace

std::span<const Danger> dangers() { return table; }

bool logarithmic(const ParameterRow& row) { return row.slider_min > 0 && row.slider_max / row.slider_min >= 500; }

void tint_dangers(const ParameterRow& row) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float rounding = ImGui::GetStyle().FrameRounding;
  const auto end_of = [&](const Danger& danger) {  // where the next level begins, or the track ends
    const Danger* next = &danger + 1;
    const bool last = next == std::end(table) || next->key != danger.key;
    return last ? high.x : place_on_slider(row, next->from, low.x, high.x);
  };
  for (const Danger& danger : table) {
    if (danger.key != row.key) continue;
    const float begin = place_on_slider(row, danger.from, low.x, high.x), end = end_of(danger);
    const ImDrawFlags corners = end == high.x ? ImDrawFlags_RoundCornersRight : ImDrawFlags_RoundCornersNone;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({begin, low.y}, {end, high.y}, ImGui::GetColorU32(colour_of(danger.level, 0.30f)), rounding,
                       corners);
    const float thick = std::max(1.0f, 0.08f * ImGui::GetFontSize());
    list.AddLine({begin, low.y}, {begin, high.y}, ImGui::GetColorU32(colour_of(danger.level, 0.9f)), thick);
  }
}

void tell_dangers(const ParameterRow& row) {
  bool any = false;
  for (const Danger& danger : table) {
    if (danger.key != row.key) continue;
    any = true;
    const std::string unit = row.unit == "1" ? "" : " " + written_unit(row.unit);
    ImGui::TextColored(colour_of(danger.level, 1), "From %s%s on:", number_text(danger.from).c_str(), unit.c_str());
    ImGui::SameLine();
    ImGui::TextWrapped("%s", danger.why);
  }
  if (any) ImGui::TextWrapped("So the model by itself; while energy.guard is on, it cannot gain what nothing lost.");
}

}  // namespace curlew
