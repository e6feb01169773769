// The bar at the top: scenes, play and pause, pictures and films, and which panels are shown.
#include <imgui.h>

#include "app/gui/interface.h"
#include "app/gui/style.h"

namespace curlew {

// One scene of the list: its name, and beneath it what it shows.
void Interface::draw_scene_choice(const SceneInfo& info) {
  const ImVec2 at = ImGui::GetCursorPos();
  const float line = ImGui::GetTextLineHeight(), width = ImGui::GetContentRegionAvail().x;
  const float about = ImGui::CalcTextSize(info.about.c_str(), nullptr, false, width).y;
  if (ImGui::Selectable(("##" + info.name).c_str(), info.name == scene_name_, 0, {0, 1.2f * line + about})) {
    open(info.name);
  }
  mark("scene " + info.name);
  const ImVec2 below = ImGui::GetCursorPos();
  ImGui::SetCursorPos(at);
  ImGui::TextUnformatted(info.name.c_str());
  ImGui::SetCursorPos({at.x, at.y + 1.1f * line});
  ImGui::PushTextWrapPos(at.x + width);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextUnformatted(info.about.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPos(below);
}

// How many rows of buttons a window of this width needs.
int Interface::toolbar_rows(float width) const { return width < 64 * ImGui::GetFontSize() ? 2 : 1; }

void Interface::draw_toolbar(float height) {
  begin_panel("Tools", 0, 0, ImGui::GetIO().DisplaySize.x, height, ImGuiWindowFlags_NoScrollbar);
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(11 * em);
  ImGui::SetNextWindowSizeConstraints({44 * em, 0}, {44 * em, ImGui::GetIO().DisplaySize.y - height});
  if (ImGui::BeginCombo("##scene", scene_.name.empty() ? "choose a scene" : scene_.name.c_str())) {
    for (const SceneInfo& info : bundled_) draw_scene_choice(info);
    ImGui::EndCombo();
  }
  mark("scene");
  if (ImGui::IsItemHovered() && !scene_.about.empty()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(28 * em);
    ImGui::TextUnformatted(scene_.about.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  const bool there = status_.state != RunState::empty, playing = status_.state == RunState::playing;
  const auto same_size = [&](const char* label, const char* name, const char* tip, bool enabled) {
    ImGui::SameLine();
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label, {4.2f * em, 0});
    ImGui::EndDisabled();
    mark(name);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", tip);
    return pressed;
  };
  if (same_size(playing ? "Pause" : "Play", "play", "Let the water run, or hold it (Space)", there)) {
    session_.play(!playing);
  }
  if (same_size("Step", "step", "One time step (S)", there && !playing)) session_.step_once();
  if (same_size("Reset", "reset", "From the start, with the parameters as they are set (R)", there)) lay_out_again();
  ImGui::SameLine(0, 2 * em);
  if (button("Picture", "Save the picture of the water (P)", there)) requests_.screenshot = true;
  ImGui::SameLine();
  if (button("Window", "Save a picture of the whole window (Shift-P)", there)) {
    requests_.screenshot = requests_.with_interface = true;
  }
  ImGui::SameLine();
  if (status_.recording) {
    if (button("End recording", "Finish the film or the frames")) requests_.stop_recording = true;
  } else {
    if (button("Film", "Film the run at 60 frames a simulated second, as mp4", there)) requests_.start_recording = true;
    ImGui::SameLine();
    if (button("Frames", "The same as PNG pictures in a folder", there)) {
      requests_.start_recording = requests_.as_frames = true;
    }
  }
  if (toolbar_rows(ImGui::GetIO().DisplaySize.x) == 1) ImGui::SameLine(0, 2 * em);
  ImGui::Checkbox("parameters", &show_parameters_);
  mark("show parameters");
  ImGui::SameLine();
  ImGui::Checkbox("view", &show_view_);
  mark("show view");
  ImGui::SameLine();
  ImGui::Checkbox("plots", &show_plots_);
  mark("show plots");
  ImGui::SameLine();
  if (button("Help", "Keys and mouse (H)")) show_help_ = !show_help_;
  ImGui::End();
}

}  // namespace curlew
