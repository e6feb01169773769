// The parameters, from their table: sliders with unit, range, symbol and tool tip, undo, and scene files.
#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "app/gui/danger.h"
#include "app/gui/interface.h"
#include "app/gui/style.h"
#include "sim/core/error.h"
#include "sim/io/atomic_file.h"
#include "sim/scene/reader.h"

namespace curlew {
namespace {

std::string member_of(const ParameterRow& row) { return row.key.substr(row.key.find('.') + 1); }

std::string label_of(const ParameterRow& row) {
  std::string name = member_of(row);
  if (row.key == "vorticity_refinement.alpha") name = "refinement";
  if (row.key == "micropolar.nu_t") name = "spin transfer";
  if (row.key == "micropolar.eta") name = "smoothing of spins";
  if (row.key == "vorticity_confinement.epsilon") name = "confinement";
  if (row.key == "wavelet.amplitude") name = "wavelet turbulence";
  if (row.key == "sub_particles.levels") name = "sub-particles";
  if (row.key == "sub_particles.critical_energy") name = "split above";
  for (char& c : name) c = c == '_' ? ' ' : c;
  std::string label = row.symbol.empty() ? name : written_symbol(row.symbol) + "  " + name;
  if (row.unit != "1" && !row.unit.empty()) label += " (" + written_unit(row.unit) + ")";
  return label;
}

void tool_tip(const ParameterRow& row) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
  ImGui::TextUnformatted(row.key.c_str());
  ImGui::TextUnformatted(row.doc.c_str());
  tell_dangers(row);
  if (row.type == ParameterRow::Type::real || row.type == ParameterRow::Type::count) {
    ImGui::TextDisabled("default %s, slider %s to %s, limits %s to %s%s%s", number_text(row.default_value).c_str(),
                        number_text(row.slider_min).c_str(), number_text(row.slider_max).c_str(),
                        number_text(row.min).c_str(), number_text(row.max).c_str(), row.unit == "1" ? "" : " ",
                        row.unit == "1" ? "" : written_unit(row.unit).c_str());
    ImGui::TextDisabled("Ctrl-click to type a number, double-click the name to go back to the scene's own value.");
  } else {
    ImGui::TextDisabled("default %s. Double-click the name to go back to the scene's own value.",
                        parameter_text(row, row.default_value).c_str());
  }
  if (!row.live) ImGui::TextDisabled("Counts from the next layout: press Apply.");
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

// The widget that fits the row's type; true while a hand changes `value`.
template <class Mark>
bool edit(const ParameterRow& row, double& value, const Mark& mark) {
  const std::string id = "##" + row.key;
  switch (row.type) {
    case ParameterRow::Type::flag: {
      bool on = value != 0;
      const bool changed = ImGui::Checkbox(id.c_str(), &on);
      value = on ? 1 : 0;
      return changed;
    }
    case ParameterRow::Type::choice: {
      int index = static_cast<int>(value);
      bool changed = false;
      const bool narrow = slider_width() < 7 * ImGui::GetFontSize();
      if (ImGui::BeginCombo(id.c_str(), row.names[static_cast<std::size_t>(index)].c_str(),
                            narrow ? ImGuiComboFlags_NoArrowButton : 0)) {
        for (int k = 0; k < static_cast<int>(row.names.size()); ++k) {
          if (ImGui::Selectable(row.names[static_cast<std::size_t>(k)].c_str(), k == index)) {
            changed = k != index;
            value = k;
          }
          mark(row.key + " " + row.names[static_cast<std::size_t>(k)]);
        }
        ImGui::EndCombo();
      }
      return changed;
    }
    case ParameterRow::Type::count: {
      int number = static_cast<int>(value);
      const bool changed =
          ImGui::SliderInt(id.c_str(), &number, static_cast<int>(row.slider_min), static_cast<int>(row.slider_max));
      value = number;
      return changed;
    }
    case ParameterRow::Type::real:
      break;
  }
  return ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &row.slider_min, &row.slider_max,
                             logarithmic(row) ? "%.2e" : "%.4g",
                             logarithmic(row) ? ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat
                                              : ImGuiSliderFlags_NoRoundToFormat);
}

}  // namespace

void Interface::draw_parameter(const ParameterRow& row) {
  const double own = row.get(own_);
  double value = held_ == &row ? held_value_ : row.get(scene_.parameters);
  const bool changed_from_own = row.get(scene_.parameters) != own;
  ImGui::PushID(row.key.c_str());
  ImGui::SetNextItemWidth(slider_width());
  const bool touched = edit(row, value, [this](const std::string& widget) { mark(widget); });
  const bool released = ImGui::IsItemDeactivatedAfterEdit(), active = ImGui::IsItemActive();
  const bool instant = row.type == ParameterRow::Type::flag || row.type == ParameterRow::Type::choice;
  mark(row.key);
  if (!(active && ImGui::GetIO().WantTextInput)) tint_dangers(row);
  tool_tip(row);
  ImGui::SameLine();
  const std::string label = label_of(row);
  if (changed_from_own || waits(row)) {
    ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s %s", label.c_str(), waits(row) ? "(!)" : "*");
  } else {
    ImGui::TextUnformatted(label.c_str());
  }
  mark("label " + row.key);
  tool_tip(row);
  Parameters next = scene_.parameters;
  try {
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0) && changed_from_own) {
      row.set(next, own);
      change(next);
    } else if ((touched || released) && !dropped_) {
      held_ = &row;
      held_value_ = value;
      if (released || instant) {
        held_ = nullptr;
        set_parameter(next, row, value, "The slider");
        change(next);
      } else if (row.live && !ImGui::GetIO().WantTextInput) {
        // While the slider moves the water follows, and undo waits for its end. A number that is being typed is not
        // one yet.
        set_parameter(next, row, value, "The slider");
        session_.set_parameters(next);
      }
    } else if (held_ == &row && !active) {
      held_ = nullptr;  // let go without a change
    }
  } catch (const InputError& error) {
    held_ = nullptr;
    session_.set_parameters(scene_.parameters);
    say(error.what(), true);
  }
  ImGui::PopID();
}

bool Interface::waits(const ParameterRow& row) const {
  return !row.live && status_.state != RunState::empty && row.get(scene_.parameters) != row.get(solver_);
}

void Interface::change(const Parameters& next) {
  past_.push_back(scene_.parameters);
  future_.clear();
  scene_.parameters = next;
  session_.set_parameters(next);
}

void Interface::undo() {
  if (past_.empty()) return;
  future_.push_back(scene_.parameters);
  scene_.parameters = past_.back();
  past_.pop_back();
  session_.set_parameters(scene_.parameters);
}

void Interface::redo() {
  if (future_.empty()) return;
  past_.push_back(scene_.parameters);
  scene_.parameters = future_.back();
  future_.pop_back();
  session_.set_parameters(scene_.parameters);
}

void Interface::draw_resolution() {
  ImGui::SetNextItemWidth(slider_width());
  ImGui::InputInt("particles", &wanted_particles_, 0, 0);
  mark("particles");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Lays the scene out anew with the spacing that comes nearest.");
  ImGui::SameLine();
  if (button("Apply", "Lay out the scene with this many particles and with the parameters that need it")) apply();
}

void Interface::apply() {
  if (wanted_particles_ < 1) {
    say("The number of particles has to be at least 1", true);
  } else if (wanted_particles_ == laid_out_particles_) {
    lay_out_again();
  } else {
    lay_out_again(wanted_particles_);
  }
}

void Interface::save_scene() {
  try {
    const std::string path = file_[0] == 0 ? new_file("scene", "json").string() : std::string(file_);
    if (path != saved_file_ && std::filesystem::exists(path)) {
      throw InputError(path + " is there already; type another name, or none for a new one");
    }
    Scene saved = scene_;
    saved.camera = view_.camera;
    saved.look = view_.look;
    saved.look.cut = cut();
    if (!own_range_) saved.look.range.reset();
    AtomicFile file(path);
    file.write(scene_json(saved));
    file.commit();
    saved_file_ = path;
    std::snprintf(file_, sizeof file_, "%s", path.c_str());
    say("Saved " + path + "; run it with: curlew run " + path);
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

void Interface::draw_files() {
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##file", "scene file, such as my_scene.json", file_, sizeof file_);
  mark("file");
  if (button("Load", "Open the scene file named above", file_[0] != 0)) open(file_);
  ImGui::SameLine();
  if (button("Save", "Save the scene with these parameters, this camera and look")) save_scene();
  same_line_if_fits("Copy command");
  if (button("Copy command", "Copy the command line that runs this scene with these parameters without a window")) {
    ImGui::SetClipboardText(command_line().c_str());
    say("Copied: " + command_line());
  }
  same_line_if_fits("Checkpoint");
  if (button("Checkpoint", "Save the state; `curlew run --resume` goes on from it with the same bits")) {
    session_.save_checkpoint(new_file("checkpoint", "curlew").string());
  }
}

void Interface::draw_parameters() {
  if (!ImGui::IsAnyItemActive()) dropped_ = false;
  if (button("Undo", "Take the last change back (Ctrl-Z)", !past_.empty())) undo();
  ImGui::SameLine();
  if (button("Redo", "Make it again (Ctrl-Y)", !future_.empty())) redo();
  ImGui::SameLine();
  if (button("Scene's own", "All parameters as the scene has them")) change(own_);
  const auto& rows = parameter_table();
  const auto waiting = std::count_if(rows.begin(), rows.end(), [this](const ParameterRow& row) { return waits(row); });
  if (waiting > 0) {
    ImGui::SameLine();
    const std::string label = "Apply " + std::to_string(waiting);
    ImGui::PushID("waiting");
    const bool pressed = button(label.c_str(), "Lay the scene out anew: what was changed counts from then on");
    ImGui::PopID();
    mark("Apply waiting");
    if (pressed) apply();
  }
  const bool files = ImGui::CollapsingHeader("Scene file", ImGuiTreeNodeFlags_DefaultOpen);
  mark("Scene file");
  if (files) draw_files();
  const bool turbulence = ImGui::CollapsingHeader("Turbulence", ImGuiTreeNodeFlags_DefaultOpen);
  mark("Turbulence");
  if (turbulence) draw_turbulence();
  std::string heading;
  bool open = false;
  const auto shown_above = turbulence_keys();
  for (const ParameterRow& row : parameter_table()) {
    if (std::find(shown_above.begin(), shown_above.end(), row.key) != shown_above.end()) continue;
    if (row.heading != heading) {
      heading = row.heading;
      const bool first = row.group == "viscosity" || row.group == "time" || row.group == "micropolar";
      open = ImGui::CollapsingHeader(heading.c_str(), first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
      mark("group " + row.group);
      if (open && row.group == "sph") draw_resolution();
    }
    if (open) draw_parameter(row);
  }
}

}  // namespace curlew
