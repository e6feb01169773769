// The main slider of each turbulence model, and the settings of all of them that the papers compare.
#include <imgui.h>

#include <algorithm>

#include "app/gui/interface.h"
#include "app/gui/presets.h"
#include "app/gui/style.h"

namespace curlew {
namespace {

void preset_tool_tip(const TurbulencePreset& preset) {
  if (!ImGui::IsItemHovered()) return;
  const auto setting = [](const char* key, double value) {
    const ParameterRow& row = parameter_row(key);
    const std::string unit = row.unit == "1" ? "" : " " + written_unit(row.unit);
    return written_symbol(row.symbol) + " = " + number_text(value) + unit;
  };
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
  ImGui::TextUnformatted(preset.doc);
  ImGui::TextDisabled(
      "Sets %s, %s, %s, %s, %s, and the inviscid micropolar model; all else stays.",
      setting("vorticity_refinement.alpha", preset.alpha).c_str(), setting("micropolar.nu_t", preset.nu_t).c_str(),
      setting("vorticity_confinement.epsilon", preset.epsilon).c_str(),
      setting("wavelet.amplitude", preset.amplitude).c_str(), setting("sub_particles.levels", preset.levels).c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

std::span<const std::string_view> turbulence_keys() {
  static constexpr std::string_view keys[] = {"vorticity_refinement.alpha",
                                              "vorticity_refinement.reconstruction",
                                              "micropolar.nu_t",
                                              "micropolar.eta",
                                              "vorticity_confinement.epsilon",
                                              "wavelet.amplitude",
                                              "sub_particles.levels",
                                              "energy.guard"};
  return keys;
}

// Shows which preset the sliders stand at, and sets all models at once, as one change.
void Interface::draw_preset_choice() {
  const TurbulencePreset* now = preset_of(scene_.parameters);
  // The names are longer than numbers, and "preset" is shorter than the sliders' names.
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("preset").x;
  ImGui::SetNextItemWidth(std::min(9.5f * ImGui::GetFontSize(), room - 2 * ImGui::GetStyle().ItemSpacing.x));
  const bool open = ImGui::BeginCombo("##preset", now != nullptr ? now->name : "own", ImGuiComboFlags_HeightLarge);
  if (!open) {
    mark("preset");
    if (now != nullptr) {
      preset_tool_tip(*now);
    } else if (ImGui::IsItemHovered()) {
      ImGui::SetTooltip("Strengths of your own; choose those that a paper uses.");
    }
  } else {
    for (const TurbulencePreset& preset : turbulence_presets()) {
      if (ImGui::Selectable(preset.name, &preset == now) && &preset != now) {
        change(with_preset(scene_.parameters, preset));
      }
      mark(std::string("preset ") + preset.name);
      preset_tool_tip(preset);
    }
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  ImGui::TextUnformatted("preset");
  mark("label preset");
}

void Interface::draw_turbulence() {
  draw_preset_choice();
  for (const std::string_view key : turbulence_keys()) draw_parameter(parameter_row(key));
}

}  // namespace curlew
