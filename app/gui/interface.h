// The interface of the window: widgets, what they have been set to, and what they ask for. Draws with Dear ImGui into
// whatever is current, a window or an off-screen target, and talks to the run through a Session.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/gui/orbit.h"
#include "app/gui/plot.h"
#include "app/session.h"
#include "render/renderer.h"
#include "sim/scene/bundled.h"

namespace curlew {

// Parameters whose sliders stand together under "Turbulence", and not again in their groups.
std::span<const std::string_view> turbulence_keys();

class Interface {
 public:
  struct Settings {
    std::filesystem::path assets;       // folder of the bundled scenes
    std::filesystem::path out = "out";  // where screenshots, films, checkpoints and saved scenes go
    double scale = 1;                   // of the display
    std::uint64_t seed = 0;
  };
  Interface(Session& session, Settings settings);

  // A bundled name or a file. What is wrong with it is shown, not thrown.
  void open(const std::string& name);
  // The same with changes that were made on the way; `own` is the scene as its file has it.
  void open(const std::string& name, const Scene& scene, const Scene& own);
  void take(Session::Update update);
  void say(const std::string& message, bool error = false);

  // All widgets for one picture of the window, between ImGui::NewFrame() and ImGui::Render(). `picture` is the texture
  // of the water, 0 before there is one.
  void draw(unsigned picture);

  // A key went down: its letter or digit as in ASCII, upper case. Kept until the next draw(), so that a short tap
  // between two pictures counts.
  void press(int key, bool ctrl, bool shift) { keys_.push_back({key, ctrl, shift}); }

  // What the water's picture has to show; version() changes when it does.
  std::shared_ptr<const Frame> frame() const { return shown_; }
  const ViewSettings& view() const { return view_; }
  std::uint64_t version() const { return version_; }
  std::array<int, 2> picture_size() const { return picture_size_; }

  // What a hand has asked for since the last call, for the window to do.
  struct Requests {
    bool screenshot = false, with_interface = false;
    bool start_recording = false, stop_recording = false;
    bool as_frames = false;  // PNG files, not a film
    bool restyle = false;
    bool quit = false;
  };
  Requests take_requests();
  bool dark() const { return dark_; }
  // What the window tells of its pictures of running water.
  void drew_water(double seconds_since_last);
  // Of the wall time, what may go into drawing while the water runs.
  double drawing_share() const { return static_cast<double>(drawing_percent_) / 100; }
  double scale() const { return scale_; }
  // out/NAME/KIND_000.EXTENSION, the first number that is free; a folder where there is no extension.
  std::filesystem::path new_file(const std::string& kind, const std::string& extension);
  // A frame as the picture shows it: without what the cut takes away.
  std::optional<Cut> cut() const;
  std::shared_ptr<const Frame> cut_open(const std::shared_ptr<const Frame>& frame) const;

  const Scene& scene() const { return scene_; }
  const std::vector<Sample>& samples() const { return samples_; }
  const SessionStatus& status() const { return status_; }
  const std::string& message() const { return message_; }
  std::string command_line() const;

  // Where a widget was drawn last (left, top, right, bottom in pixels); throws where there is none. For scripts.
  std::array<float, 4> place(std::string_view widget) const;

 private:
  struct Key {
    int key;
    bool ctrl, shift;
  };

  // A scene that was asked for and does not stand yet; `fresh` where it is another one.
  struct Pending {
    std::string name;
    Scene scene, own;
    bool fresh;
  };
  // Of a parameter that is set and not read yet, because it counts from the next layout.
  bool waits(const ParameterRow& row) const;
  void install(const Pending& next);
  // The scene from the start, with the parameters as they are set; with another spacing where a number is given.
  void lay_out_again(std::optional<double> particles = {});

  // interface.cpp: layout, picture, shortcuts; toolbar.cpp; notices.cpp
  void draw_toolbar(float height);
  void draw_scene_choice(const SceneInfo& info);
  int toolbar_rows(float width) const;
  void draw_picture(unsigned picture, std::array<float, 4> box);
  void draw_status(float height);
  void draw_help();
  void draw_loading();
  void halve_time_step();
  void handle_keys();
  void handle_key(const Key& pressed);
  void handle_mouse(std::array<float, 4> box);
  void update_view();
  bool button(const char* label, const char* tip, bool enabled = true);
  void mark(std::string_view widget);
  void show_settings_changed();

  // parameters_panel.cpp
  void draw_parameters();
  void draw_parameter(const ParameterRow& row);
  void draw_resolution();
  void draw_files();
  void change(const Parameters& next);  // with undo
  void undo(), redo();
  void save_scene();
  void apply();

  // turbulence_panel.cpp
  void draw_turbulence();
  void draw_preset_choice();

  // view_panel.cpp
  bool draw_colour_choice();  // true where another was chosen
  bool draw_style_choice();   // true where another look was chosen
  void draw_view();

  // plots_panel.cpp
  void draw_plots();

  Session& session_;
  Settings settings_;
  std::vector<SceneInfo> bundled_;

  Scene scene_;                         // as it will be laid out next: with the parameters as they are set
  Parameters own_;                      // as the scene's file has them
  double own_radius_ = 0;               // the same
  std::string scene_name_;              // as one gives it on the command line
  const ParameterRow* held_ = nullptr;  // whose widget a hand holds, and what it stands at
  double held_value_ = 0;
  bool dropped_ = false;  // what the hand holds no longer counts, until it lets go
  std::vector<Parameters> past_, future_;
  char file_[256] = "";
  int wanted_particles_ = 0, laid_out_particles_ = 0;
  std::string saved_file_;  // the last that Save wrote
  std::set<std::filesystem::path> given_;
  std::string message_;
  bool message_is_error_ = false;
  double message_time_ = 0;

  std::optional<Pending> pending_;
  Parameters solver_;  // that the run reads
  SessionStatus status_;
  std::int64_t scene_number_ = 0;
  std::vector<Sample> samples_;
  std::vector<Sample> paused_samples_;
  bool plots_paused_ = false;

  std::shared_ptr<const Frame> latest_, shown_;
  ViewSettings view_;
  Orbit orbit_;
  bool orbit_is_new_ = true, orbit_is_own_ = false;  // to be taken from the scene; moved by hand
  std::uint64_t version_ = 0;
  std::optional<std::array<double, 2>> range_;  // of the colours so far
  bool own_range_ = false;                      // the user's
  float particle_scale_ = 1;
  void adopt_cut(const std::optional<Cut>& cut);
  bool cut_ = false;
  int cut_axis_ = 2;
  float cut_at_ = 0.5f;
  bool cut_low_ = false;

  bool show_parameters_ = true, show_view_ = true, show_plots_ = true, show_help_ = false, dark_ = false;
  float drawing_percent_ = 20;
  double between_pictures_ = 0;  // s, a running mean; 0 before there is one
  double scale_ = 1;
  std::array<int, 2> picture_size_{640, 360};
  Requests requests_;
  std::vector<Key> keys_;
  std::map<std::string, std::array<float, 4>, std::less<>> places_;
};

}  // namespace curlew
