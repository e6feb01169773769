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
#include "sim/scene/reader.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

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

void Interface::lay_out_again(std::optional<double> particles) {
  Pending next{scene_name_, scene_, scene_, false};
  next.own.parameters = own_;
  next.own.particle_radius = own_radius_;
  pending_ = next;
  session_.open(scene_, settings_.seed, particles);
}

// The scene that was asked for stands: from here on the widgets speak of it.
void Interface::install(const Pending& next) {
  if (next.fresh && held_ != nullptr) {  // what a hand holds was meant for the scene before
    held_ = nullptr;
    dropped_ = true;
  }
  between_pictures_ = 0;
  const Parameters set = scene_.parameters;
  scene_ = next.scene;
  if (!next.fresh) scene_.parameters = set;  // also what was changed while it was laid out
  session_.set_parameters(scene_.parameters);
  scene_.particle_radius = status_.particle_radius;
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
  session_.show_as(scene_.look.style);
  adopt_cut(scene_.look.cut);
}

void Interface::take(Session::Update update) {
  status_ = std::move(update.status);
  solver_ = update.parameters;
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
    char number[16];
    std::snprintf(number, sizeof number, "_%03d", n);
    const auto path = folder / (kind + number + (extension.empty() ? "" : "." + extension));
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

void Interface::drew_water(double seconds_since_last) {
  const double mixed = 0.7 * between_pictures_ + 0.3 * seconds_since_last;
  between_pictures_ = between_pictures_ > 0 ? mixed : seconds_since_last;
}

std::optional<Cut> Interface::cut() const {
  if (!cut_) return {};
  const int axis = std::min(cut_axis_, scene_.dimension - 1);
  const double low = scene_.domain.min[axis], high = scene_.domain.max[axis];
  return Cut{axis, low + double{cut_at_} * (high - low), cut_low_};
}

void Interface::adopt_cut(const std::optional<Cut>& cut) {
  cut_ = cut.has_value();
  if (!cut) return;
  const double low = scene_.domain.min[cut->axis], high = scene_.domain.max[cut->axis];
  cut_axis_ = cut->axis;
  cut_at_ = static_cast<float>(std::clamp((cut->at - low) / (high - low), 0.0, 1.0));
  cut_low_ = cut->keep_high;
}

std::shared_ptr<const Frame> Interface::cut_open(const std::shared_ptr<const Frame>& frame) const {
  const std::optional<Cut> cut = this->cut();
  return cut ? std::make_shared<Frame>(curlew::cut_open(*frame, *cut)) : frame;
}

void Interface::draw(unsigned picture) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const auto em = static_cast<float>(14 * scale_);
  // Whole pixels: between them the background would show.
  const float bar = std::ceil(toolbar_rows(size.x) == 1 ? 2.7f * em : 4.5f * em), line = std::ceil(1.9f * em);
  const float left = show_parameters_ ? std::ceil(std::min(25 * em, 0.45f * size.x)) : 0;
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
  if (key == 'R') lay_out_again();
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

}  // namespace curlew
