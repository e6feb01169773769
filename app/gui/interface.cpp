#include "app/gui/interface.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "app/gui/style.h"
#include "app/numbers.h"
#include "render/colour_range.h"
#include "sim/core/error.h"
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

constexpr ImGuiWindowFlags panel_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void begin_panel(const char* name, float x, float y, float width, float height, ImGuiWindowFlags flags = 0) {
  ImGui::SetNextWindowPos({x, y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin(name, nullptr, panel_flags | flags);
}

// Messages stay this long; errors until the next.
constexpr double message_seconds = 8;
constexpr std::size_t most_samples = 400000;

}  // namespace

Interface::Interface(Session& session, Settings settings) : session_(session), settings_(std::move(settings)) {
  bundled_ = bundled_scenes(settings_.assets);
  scale_ = settings_.scale;
}

void Interface::open(const std::string& name) {
  try {
    const Scene scene = read_scene(find_scene(name, settings_.assets));
    check_resolution(scene);
    open(name, scene, scene);
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

void Interface::open(const std::string& name, const Scene& scene, const Scene& own) {
  pending_ = Pending{name, scene, own, true};
  session_.open(scene, settings_.seed);
}

void Interface::lay_out_again(const Scene& scene) {
  Pending next{scene_name_, scene, scene, false};
  next.own.parameters = own_;
  next.own.particle_radius = own_radius_;
  pending_ = next;
  session_.open(scene, settings_.seed);
}

// The scene that was asked for stands: from here on the widgets speak of it.
void Interface::install(const Pending& next) {
  held_ = nullptr;
  scene_ = next.scene;
  own_ = next.own.parameters;
  own_radius_ = next.own.particle_radius;
  samples_.clear();
  paused_samples_.clear();
  if (!own_range_) range_.reset();
  if (!next.fresh) return;
  if (next.name != scene_name_ && next.name != file_) file_[0] = 0;
  scene_name_ = next.name;
  past_.clear();
  future_.clear();
  view_.look = scene_.look;
  dark_ = dark_ || scene_.look.background == "dark";
  view_.look.background = dark_ ? "dark" : "light";
  requests_.restyle = true;
  range_ = scene_.look.range;
  own_range_ = range_.has_value();
  orbit_is_new_ = true;
  latest_ = nullptr;  // it shows the scene before
  session_.colour_by(scene_.look.colour_by);
}

void Interface::take(Session::Update update) {
  status_ = std::move(update.status);
  if (status_.scene_number != scene_number_) {
    scene_number_ = status_.scene_number;
    laid_out_particles_ = wanted_particles_ = static_cast<int>(status_.particles);
    if (pending_) install(*pending_);
  }
  if (!status_.loading) pending_.reset();
  if (samples_.size() > most_samples) samples_.erase(samples_.begin(), samples_.begin() + most_samples / 2);
  samples_.insert(samples_.end(), update.samples.begin(), update.samples.end());
  for (const Message& message : update.messages) say(message.text, message.error);
  if (update.frame) {
    latest_ = std::move(update.frame);
    update_view();
  }
}

void Interface::say(const std::string& message, bool error) {
  message_ = message;
  message_is_error_ = error;
  message_time_ = ImGui::GetCurrentContext() != nullptr ? ImGui::GetTime() : 0;
}

Interface::Requests Interface::take_requests() { return std::exchange(requests_, {}); }

std::filesystem::path Interface::new_file(const std::string& kind, const std::string& extension) {
  const std::filesystem::path folder = settings_.out / std::filesystem::path(scene_.file).stem();
  for (int n = 0;; ++n) {
    char name[32];
    std::snprintf(name, sizeof name, "_%03d.", n);
    const auto path = folder / (kind + name + extension);
    std::error_code ignored;
    // A name that was handed out counts as taken: its file may be written later.
    if (!std::filesystem::exists(path, ignored) && given_.insert(path).second) return path;
  }
}

std::string Interface::command_line() const {
  const bool plain = scene_name_.find_first_of(" '\"\\$&;()") == std::string::npos;
  std::string line = "curlew run " + (plain ? scene_name_ : "\"" + scene_name_ + "\"");
  if (settings_.seed != 0) line += " --seed " + std::to_string(settings_.seed);
  if (scene_.particle_radius != own_radius_) line += " --radius " + number_text(scene_.particle_radius);
  for (const ParameterRow& row : parameter_table()) {
    if (row.get(scene_.parameters) != row.get(own_)) {
      line += " --set " + row.key + "=" + parameter_text(scene_.parameters, row);
    }
  }
  return line + " --frames";
}

std::array<float, 4> Interface::place(std::string_view widget) const {
  const auto found = places_.find(widget);
  if (found == places_.end()) throw std::out_of_range("no widget \"" + std::string(widget) + "\" was drawn");
  return found->second;
}

void Interface::mark(std::string_view widget) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_.insert_or_assign(std::string(widget), std::array<float, 4>{low.x, low.y, high.x, high.y});
}

bool Interface::button(const char* label, const char* tip, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label);
  ImGui::EndDisabled();
  mark(label);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", tip);
  return pressed;
}

void Interface::show_settings_changed() { update_view(); }

// The frame and the view of it, from the newest state and the settings of the panels.
void Interface::update_view() {
  ++version_;
  if (!latest_) return;
  const double aspect = static_cast<double>(picture_size_[0]) / picture_size_[1];
  if (orbit_is_new_) {
    orbit_ = Orbit(scene_.camera, latest_->geometry->domain, latest_->geometry->dimension, aspect);
    orbit_is_new_ = orbit_is_own_ = false;
  }
  view_.camera = orbit_.camera();
  view_.flat_zoom = orbit_.flat_zoom();
  view_.particle_scale.reset();
  if (particle_scale_ != 1) view_.particle_scale = double{particle_scale_};
  if (!own_range_ && !latest_->value.empty() && latest_->colour.name == view_.look.colour_by) {
    const auto own = colour_range(*latest_);
    range_ = range_ ? united(*range_, own) : own;
  }
  view_.look.range = range_;
  shown_ = cut_open(latest_);
}

std::shared_ptr<const Frame> Interface::cut_open(const std::shared_ptr<const Frame>& frame) const {
  if (!cut_) return frame;
  const Domain& domain = frame->geometry->domain;
  const int axis = std::min(cut_axis_, frame->geometry->dimension - 1);
  const double low = domain.min[axis], high = domain.max[axis];
  const auto plane = static_cast<float>(low + double{cut_at_} * (high - low));
  auto cut = std::make_shared<Frame>(*frame);
  cut->position.clear();
  cut->value.clear();
  for (std::size_t i = 0; i < frame->position.size(); ++i) {
    if ((frame->position[i][axis] > plane) != cut_low_) continue;
    cut->position.push_back(frame->position[i]);
    if (!frame->value.empty()) cut->value.push_back(frame->value[i]);
  }
  return cut;
}

void Interface::draw(unsigned picture) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const auto em = static_cast<float>(14 * scale_);
  // Whole pixels: between them the background would show.
  const float bar = std::ceil(2.7f * em), line = std::ceil(1.9f * em);
  const float left = show_parameters_ ? std::ceil(std::min(25 * em, 0.4f * size.x)) : 0;
  const float right = show_view_ ? std::ceil(std::min(17 * em, 0.3f * size.x)) : 0;
  const float bottom = show_plots_ ? std::ceil(std::min(14 * em, 0.35f * size.y)) : 0;
  places_.clear();
  handle_keys();
  draw_toolbar(bar);
  if (show_parameters_) {
    begin_panel("Parameters", 0, bar, left, size.y - bar - bottom - line);
    draw_parameters();
    ImGui::End();
  }
  if (show_view_) {
    begin_panel("View", size.x - right, bar, right, size.y - bar - bottom - line);
    draw_view();
    ImGui::End();
  }
  draw_picture(picture, {left, bar, size.x - right, size.y - bottom - line});
  if (show_plots_) {
    begin_panel("Plots", 0, size.y - bottom - line, size.x, bottom);
    draw_plots();
    ImGui::End();
  }
  draw_status(line);
  if (status_.loading) draw_loading();
  if (show_help_) draw_help();
}

void Interface::draw_toolbar(float height) {
  begin_panel("Tools", 0, 0, ImGui::GetIO().DisplaySize.x, height, ImGuiWindowFlags_NoScrollbar);
  ImGui::SetNextItemWidth(11 * ImGui::GetFontSize());
  if (ImGui::BeginCombo("##scene", scene_.name.empty() ? "choose a scene" : scene_.name.c_str(),
                        ImGuiComboFlags_HeightLarge)) {
    for (const SceneInfo& info : bundled_) {
      if (ImGui::Selectable(info.name.c_str(), info.name == scene_name_)) open(info.name);
      mark("scene " + info.name);
      if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
        ImGui::TextUnformatted(info.about.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
      }
    }
    ImGui::EndCombo();
  }
  mark("scene");
  if (ImGui::IsItemHovered() && !scene_.about.empty()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
    ImGui::TextUnformatted(scene_.about.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  const bool there = status_.state != RunState::empty, playing = status_.state == RunState::playing;
  const auto same_size = [&](const char* label, const char* name, const char* tip, bool enabled) {
    ImGui::SameLine();
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label, {4.2f * ImGui::GetFontSize(), 0});
    ImGui::EndDisabled();
    mark(name);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", tip);
    return pressed;
  };
  if (same_size(playing ? "Pause" : "Play", "play", "Let the water run, or hold it (Space)", there)) {
    session_.play(!playing);
  }
  if (same_size("Step", "step", "One time step (S)", there && !playing)) session_.step_once();
  if (same_size("Reset", "reset", "From the start, with the parameters as they are set (R)", there))
    lay_out_again(scene_);
  ImGui::SameLine(0, 2 * ImGui::GetFontSize());
  if (button("Picture", "Save the picture of the water (P)", there)) requests_.screenshot = true;
  ImGui::SameLine();
  if (button("Window", "Save a picture of the whole window (Shift-P)", there)) {
    requests_.screenshot = requests_.with_interface = true;
  }
  ImGui::SameLine();
  if (button(status_.recording ? "End film" : "Film", "Film the run at 60 frames a simulated second, as mp4", there)) {
    (status_.recording ? requests_.stop_recording : requests_.start_recording) = true;
  }
  mark("film");
  ImGui::SameLine(0, 2 * ImGui::GetFontSize());
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

void Interface::draw_picture(unsigned picture, std::array<float, 4> box) {
  const int width = std::max(16, static_cast<int>(box[2] - box[0])),
            height = std::max(16, static_cast<int>(box[3] - box[1]));
  if (picture_size_ != std::array<int, 2>{width, height}) {
    picture_size_ = {width, height};
    orbit_is_new_ = orbit_is_new_ || !orbit_is_own_;  // a fitted view fits the new size
    update_view();
  }
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  begin_panel("Water", box[0], box[1], box[2] - box[0], box[3] - box[1],
              ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                  (picture != 0 ? ImGuiWindowFlags_NoBackground : 0));
  if (picture != 0) {
    // The texture's first row is the lowest.
    ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(picture)), {box[2] - box[0], box[3] - box[1]},
                 {0, 1}, {1, 0});
  }
  ImGui::SetCursorScreenPos({box[0], box[1]});
  ImGui::InvisibleButton(
      "picture", {box[2] - box[0], box[3] - box[1]},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  mark("picture");
  handle_mouse(box);
  ImGui::End();
  ImGui::PopStyleVar();
}

void Interface::handle_mouse(std::array<float, 4> box) {
  const ImGuiIO& io = ImGui::GetIO();
  const double height = double{box[3] - box[1]};
  bool changed = false;
  if (ImGui::IsItemActive() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    const double dx = double{io.MouseDelta.x}, dy = double{io.MouseDelta.y};
    const bool across =
        ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle) || io.KeyShift;
    across ? orbit_.move(dx, dy, height) : orbit_.turn(dx, dy, height);
    changed = true;
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    orbit_.zoom(double{io.MouseWheel});
    changed = true;
  }
  if (!changed) return;
  orbit_is_own_ = true;
  update_view();
}

void Interface::handle_keys() {
  const std::vector<Key> keys = std::exchange(keys_, {});
  if (ImGui::GetIO().WantTextInput) return;
  for (const Key& key : keys) handle_key(key);
}

void Interface::handle_key(const Key& pressed) {
  const int key = pressed.key;
  if (pressed.ctrl) {
    if (key == 'Z') undo();
    if (key == 'Y') redo();
    if (key == 'Q') requests_.quit = true;
    return;
  }
  if (key == 'H') show_help_ = !show_help_;
  if (status_.state == RunState::empty) return;
  const bool playing = status_.state == RunState::playing;
  if (key == ' ') session_.play(!playing);
  if (key == 'S' && !playing) session_.step_once();
  if (key == 'R') lay_out_again(scene_);
  if (key == 'P') {
    requests_.screenshot = true;
    requests_.with_interface = pressed.shift;
  }
  const double aspect = static_cast<double>(picture_size_[0]) / picture_size_[1];
  constexpr const char* sides[] = {"front", "back", "left", "right", "top", "corner"};
  const bool side = key >= '1' && key <= '6' && scene_.dimension == 3;
  if (key == 'F') orbit_.fit(scene_.domain, aspect);
  if (side) orbit_.look_from(sides[key - '1'], scene_.domain, aspect);
  if (key == 'F' || side) {
    orbit_is_own_ = true;
    update_view();
  }
}

void Interface::draw_status(float height) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  begin_panel("Status", 0, size.y - height, size.x, height, ImGuiWindowFlags_NoScrollbar);
  const char* state = status_.state == RunState::playing    ? "running"
                      : status_.state == RunState::diverged ? "diverged"
                      : status_.state == RunState::paused   ? "paused"
                                                            : "no scene";
  ImGui::Text("%s   %zu particles   t = %.3f s   step %lld   dt %.3g ms   %.3gx real time   %.3g steps/s   %.3g MB%s",
              state, status_.particles, status_.time, static_cast<long long>(status_.step), 1e3 * status_.dt,
              status_.state == RunState::playing ? status_.real_time_factor : 0.0,
              status_.state == RunState::playing ? status_.steps_a_second : 0.0,
              1e-6 * static_cast<double>(status_.solver_bytes), status_.recording ? "   filming" : "");
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
        if (button("Go on with half the time step", "Halves time.cfl, or time.fixed_step where that is set")) {
          Parameters next = scene_.parameters;
          const ParameterRow& row = parameter_row(next.time.fixed_step > 0 ? "time.fixed_step" : "time.cfl");
          row.set(next, std::max(row.min, row.get(next) / 2));
          change(next);
          message_.clear();
          session_.play(true);
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
