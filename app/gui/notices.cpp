// What the window says by itself: the line at the bottom, messages, progress, and the help.
#include <imgui.h>

#include <algorithm>

#include "app/gui/interface.h"
#include "app/gui/style.h"

namespace curlew {
namespace {

// Messages stay this long; errors until the next.
constexpr double message_seconds = 8;

}  // namespace

void Interface::draw_status(float height) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin_panel("Status", 0, size.y - height, size.x, height, ImGuiWindowFlags_NoScrollbar);
  const char* state = status_.state == RunState::playing    ? "running"
                      : status_.state == RunState::diverged ? "diverged"
                      : status_.state == RunState::paused   ? "paused"
                                                            : "no scene";
  const bool playing = status_.state == RunState::playing;
  ImGui::Text(
      "%s   %zu particles   t = %.3f s   step %lld   dt %.3g ms   %.3gx real time   %.3g steps/s   %.2g pictures/s"
      "   %.3g MB%s",
      state, status_.particles, status_.time, static_cast<long long>(status_.step), 1e3 * status_.dt,
      playing ? status_.real_time_factor : 0.0, playing ? status_.steps_a_second : 0.0,
      playing && between_pictures_ > 0 ? 1 / between_pictures_ : 0.0, 1e-6 * static_cast<double>(status_.solver_bytes),
      status_.recording ? "   recording" : "");
  mark("status");
  if (!message_.empty() && (message_is_error_ || ImGui::GetTime() - message_time_ < message_seconds)) {
    // Over the picture, where there is room for a whole sentence.
    ImGui::SetNextWindowPos(
        {0.5f * size.x, size.y -
                            (show_plots_ ? std::min(14.0f * 14 * static_cast<float>(scale_), 0.35f * size.y) : 0.0f) -
                            height - 10},
        0, {0.5f, 1});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin("Message", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    ImGui::PushTextWrapPos(34 * ImGui::GetFontSize());
    if (message_is_error_) {
      ImGui::TextColored({0.85f, 0.2f, 0.1f, 1}, "%s", message_.c_str());
      if (button("OK", "Close this message")) message_.clear();
      if (status_.state == RunState::diverged) {
        ImGui::SameLine();
        if (button("Go on with half the time step",
                   "Halves the limits of the time step (time.cfl and others), or time.fixed_step where that is set")) {
          halve_time_step();
        }
      }
    } else {
      ImGui::TextUnformatted(message_.c_str());
    }
    ImGui::PopTextWrapPos();
    ImGui::End();
  }
  ImGui::End();
}

void Interface::halve_time_step() {
  Parameters next = scene_.parameters;
  const auto halve = [&](const char* name) {
    const ParameterRow& row = parameter_row(name);
    row.set(next, std::max(row.min, row.get(next) / 2));
  };
  if (next.time.fixed_step > 0) {
    halve("time.fixed_step");
  } else {
    for (const char* limit : {"time.cfl", "time.acceleration_factor", "time.viscosity_factor", "time.max_step"})
      halve(limit);
  }
  change(next);
  message_.clear();
  session_.play(true);
}

void Interface::draw_loading() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  if (status_.loading_seconds < 0.3) return;  // what is quick needs no sign
  ImGui::SetNextWindowPos({0.5f * size.x, 0.45f * size.y}, 0, {0.5f, 0.5f});
  ImGui::Begin("Loading", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  ImGui::Text("Laying out %s ... %.1f s", status_.loading_what.c_str(), status_.loading_seconds);
  if (button("Cancel", "Keep the run that is there")) session_.cancel();
  ImGui::End();
}

void Interface::draw_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.45f * size.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
  ImGui::Begin("Keys and mouse", &show_help_,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  constexpr const char* rows[][2] = {
      {"Space", "play or pause"},
      {"S", "one step"},
      {"R", "from the start"},
      {"F", "all of the domain in sight"},
      {"1 to 6", "from the front, back, left, right, top, corner"},
      {"P, Shift-P", "save the picture, the whole window"},
      {"Ctrl-Z, Ctrl-Y", "undo, redo"},
      {"Ctrl-Q", "leave"},
      {"drag", "turn the view"},
      {"right-drag, Shift-drag", "move it"},
      {"wheel", "zoom"},
      {"double-click a name", "the scene's own value"},
      {"Ctrl-click a slider", "type a number, also beyond the slider"},
  };
  if (ImGui::BeginTable("keys", 2)) {
    for (const auto& row : rows) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(row[0]);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(row[1]);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace curlew
