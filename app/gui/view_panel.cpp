// What the picture shows: colours, cut, camera, theme.
#include <imgui.h>

#include <algorithm>

#include "app/gui/interface.h"
#include "app/gui/style.h"
#include "render/colour_range.h"
#include "sim/scene/names.h"

namespace curlew {
namespace {

// A combo over names; true where another was chosen.
template <class Names, class Mark>
bool choose(const char* label, std::string& chosen, const Names& names, const Mark& mark) {
  bool changed = false;
  if (ImGui::BeginCombo(label, chosen.c_str())) {
    for (const auto& name : names) {
      if (ImGui::Selectable(std::string(name).c_str(), chosen == name) && chosen != name) {
        chosen = name;
        changed = true;
      }
      mark(std::string(label) + " " + std::string(name));
    }
    ImGui::EndCombo();
  }
  return changed;
}

}  // namespace

// Fields of models that are off can be chosen, dimmed: they show 0 until their slider is raised.
bool Interface::draw_colour_choice() {
  const auto tell = [](const ColourField& field, std::string_view key) {
    if (!ImGui::IsItemHovered()) return;
    const std::string doc(field.doc);
    if (key.empty()) return ImGui::SetTooltip("%s", doc.c_str());
    ImGui::SetTooltip("%s\n0 while its model is off: raise %s under Turbulence.", doc.c_str(),
                      written_symbol(parameter_row(key).symbol).c_str());
  };
  // The longest name has to fit into a narrow panel.
  const float em = ImGui::GetFontSize(), room = ImGui::GetContentRegionAvail().x;
  const float beside = ImGui::CalcTextSize("colour by").x + 2 * ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(std::min(8 * em, room - beside));
  const ImGuiComboFlags arrow = room < 14 * em ? ImGuiComboFlags_NoArrowButton : 0;
  std::string& chosen = view_.look.colour_by;
  bool changed = false;
  if (ImGui::BeginCombo("colour by", chosen.c_str(), ImGuiComboFlags_HeightLarge | arrow)) {
    for (const ColourField& field : colour_fields()) {
      const std::string_view key = colour_switch(field.name, solver_);
      ImGui::PushStyleColor(ImGuiCol_Text,
                            ImGui::GetStyleColorVec4(key.empty() ? ImGuiCol_Text : ImGuiCol_TextDisabled));
      if (ImGui::Selectable(std::string(field.name).c_str(), chosen == field.name) && chosen != field.name) {
        chosen = field.name;
        changed = true;
      }
      ImGui::PopStyleColor();
      mark("colour by " + std::string(field.name));
      tell(field, key);
    }
    ImGui::EndCombo();
  } else {
    mark("colour by");
  }
  if (const std::string_view key = colour_switch(chosen, solver_); !key.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("All 0: raise %s under Turbulence", written_symbol(parameter_row(key).symbol).c_str());
    ImGui::PopStyleColor();
    mark("colour is off");
  }
  if (!changed) return false;
  session_.colour_by(chosen);
  range_.reset();
  own_range_ = false;
  return true;
}

bool Interface::draw_style_choice() {
  static constexpr const char* docs[] = {
      "The particles as spheres, coloured by a field.",
      ("Clear water by the mesh of its surface, which takes the solver's time for each picture: best with a graphics "
       "card."),
      "Clear water straight from the particles: no mesh, less exact."};
  const auto names = look_style_names();
  const auto chosen = static_cast<std::size_t>(view_.look.style);
  bool changed = false;
  if (ImGui::BeginCombo("look", std::string(names[chosen]).c_str())) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string name(names[k]);
      if (ImGui::Selectable(name.c_str(), k == chosen) && k != chosen) {
        view_.look.style = static_cast<LookStyle>(k);
        session_.show_as(view_.look.style);
        changed = true;
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", docs[k]);
      mark("look " + name);
    }
    ImGui::EndCombo();
  } else {
    mark("look");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", docs[chosen]);
  }
  return changed;
}

void Interface::draw_view() {
  const float wide = std::min(8.0f * ImGui::GetFontSize(), 0.5f * ImGui::GetContentRegionAvail().x);
  bool changed = false;
  const auto marking = [this](const std::string& widget) { mark(widget); };
  if (ImGui::CollapsingHeader("Water", ImGuiTreeNodeFlags_DefaultOpen)) {
    ImGui::SetNextItemWidth(wide);
    changed |= draw_style_choice();
    changed |= draw_colour_choice();
    ImGui::SetNextItemWidth(wide);
    changed |= choose("map", view_.look.colour_map, colour_map_names(), marking);
    mark("map");
    if (ImGui::Checkbox("fixed range", &own_range_)) {
      if (!own_range_) range_.reset();
      changed = true;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Otherwise the scale spans what the run has shown so far.");
    mark("fixed range");
    if (own_range_ && range_) {
      float ends[2] = {static_cast<float>((*range_)[0]), static_cast<float>((*range_)[1])};
      ImGui::SetNextItemWidth(wide);
      if (ImGui::InputFloat2("range", ends, "%.3g") && ends[0] < ends[1]) {
        range_ = {double{ends[0]}, double{ends[1]}};
        changed = true;
      }
    }
  }
  if (ImGui::CollapsingHeader("Shown", ImGuiTreeNodeFlags_DefaultOpen)) {
    changed |= ImGui::Checkbox("bodies", &view_.show_bodies);
    mark("bodies");
    same_line_if_fits("walls", true);
    changed |= ImGui::Checkbox("walls", &view_.look.show_walls);
    same_line_if_fits("floor", true);
    changed |= ImGui::Checkbox("floor", &view_.look.show_floor);
    same_line_if_fits("legend", true);
    changed |= ImGui::Checkbox("legend", &view_.look.show_legend);
    mark("legend");
    ImGui::SetNextItemWidth(wide);
    changed |= ImGui::SliderFloat("drop size", &particle_scale_, 0.3f, 1.5f, "%.2f");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Drawn radius over particle radius; 1 closes most gaps.");
    mark("drop size");
  }
  if (ImGui::CollapsingHeader("Cut", ImGuiTreeNodeFlags_DefaultOpen)) {
    changed |= ImGui::Checkbox("cut the water", &cut_);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Takes away what lies on one side of a plane, to see the inside.");
    mark("cut");
    if (cut_) {
      const char* axes[] = {"x", "y", "z"};
      ImGui::SetNextItemWidth(wide);
      changed |= ImGui::Combo("across", &cut_axis_, axes, scene_.dimension);
      ImGui::SetNextItemWidth(wide);
      changed |= ImGui::SliderFloat("at", &cut_at_, 0, 1, "%.3f of the domain");
      mark("cut at");
      changed |= ImGui::Checkbox("keep the other side", &cut_low_);
    }
  }
  if (ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) {
    const double aspect = static_cast<double>(picture_size_[0]) / picture_size_[1];
    int k = 0;
    for (const char* side : {"front", "back", "left", "right", "top", "corner"}) {
      if (k++ % 3 != 0) ImGui::SameLine();
      const std::string tip = "Key " + std::to_string(k);
      if (button(side, tip.c_str(), scene_.dimension == 3)) {
        orbit_.look_from(side, scene_.domain, aspect);
        orbit_is_own_ = changed = true;
      }
    }
    if (button("Fit (F)", "All of the domain in sight")) {
      orbit_.fit(scene_.domain, aspect);
      orbit_is_own_ = changed = true;
    }
    ImGui::SameLine();
    if (button("Scene's", "As the scene has its camera")) {
      orbit_is_new_ = true;
      changed = true;
    }
    ImGui::TextDisabled("drag turns, right-drag moves,\nthe wheel zooms");
  }
  if (ImGui::CollapsingHeader("Interface", ImGuiTreeNodeFlags_DefaultOpen)) {
    if (ImGui::Checkbox("dark", &dark_)) {
      view_.look.background = dark_ ? "dark" : "light";
      requests_.restyle = changed = true;
    }
    mark("dark");
    static constexpr double scales[] = {1, 1.25, 1.5, 2};
    for (const double scale : scales) {
      char label[16];
      std::snprintf(label, sizeof label, "%.3gx", scale);
      same_line_if_fits(label);
      if (button(label, "Size of text and widgets", scale_ != scale)) {
        scale_ = scale;
        requests_.restyle = true;
      }
    }
    ImGui::SetNextItemWidth(wide);
    ImGui::SliderFloat("drawing", &drawing_percent_, 5, 75, "%.0f %% of time", ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip(
          "While the water runs: more makes its motion smoother and, where no graphics card draws,\n"
          "the solver slower.");
    mark("drawing");
  }
  if (changed) show_settings_changed();
}

}  // namespace curlew
