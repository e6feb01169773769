// `curlew gui`: the window. The solver runs on its own thread; here pictures are drawn when there is something new, and
// never so often that drawing takes the solver's cores away.
#include <glad/gl.h>
// glad before GLFW
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "app/assets.h"
#include "app/commands.h"
#include "app/gui/interface.h"
#include "app/gui/recorder.h"
#include "app/gui/style.h"
#include "app/setup.h"
#include "render/gl.h"
#include "render/png.h"
#include "sim/core/error.h"
#include "sim/scene/resolution.h"

namespace curlew {
namespace {

double seconds() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

constexpr double idle_interval = 0.2, busy_interval = 1.0 / 60;  // s, between pictures of the interface
constexpr double busy_after_input = 0.5;                         // s
constexpr double still_after = 0.3;                              // s without a change
constexpr std::size_t most_losses = 5;                           // of the OpenGL context within a minute
constexpr double quick = 1.0 / 60;  // s: what takes longer to draw is drawn as a draft while it moves

void key_changed(GLFWwindow* window, int key, int, int action, int modifiers) {
  auto* interface = static_cast<Interface*>(glfwGetWindowUserPointer(window));
  if (interface == nullptr || action != GLFW_PRESS) return;
  interface->press(key, (modifiers & GLFW_MOD_CONTROL) != 0, (modifiers & GLFW_MOD_SHIFT) != 0);
}

class Window {
 public:
  Window() {
    if (glfwInit() != GLFW_TRUE) {
      const char* reason = nullptr;
      glfwGetError(&reason);
      throw GraphicsError(std::string("no window can be opened: ") + (reason != nullptr ? reason : "no display") +
                          "; run without one, for example: curlew run pillars --frames");
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SAMPLES, 0);  // the picture is smooth already, and software pays dearly
    float scale = 1, ignored = 1;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorContentScale(monitor, &scale, &ignored);
    scale_ = std::clamp(double{scale}, 1.0, 4.0);
    for (const int robustness : {GLFW_LOSE_CONTEXT_ON_RESET, GLFW_NO_ROBUSTNESS}) {
      // Without the first nobody says that the context is lost; not every driver has it.
      glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, robustness);
      if (window_ == nullptr) {
        window_ = glfwCreateWindow(static_cast<int>(1280 * scale_), static_cast<int>(720 * scale_), "Curlew", nullptr,
                                   nullptr);
      }
    }
    if (window_ == nullptr) {
      const char* reason = nullptr;
      glfwGetError(&reason);
      const std::string said = reason != nullptr ? reason : "no OpenGL 4.5";
      glfwTerminate();
      throw GraphicsError("no window with OpenGL 4.5 can be opened: " + said +
                          "; run without one, for example: curlew run pillars --frames");
    }
    glfwSetWindowSizeLimits(window_, 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(0);
    if (gladLoadGL(glfwGetProcAddress) == 0) throw GraphicsError("the window's OpenGL cannot be loaded");
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    glfwSetKeyCallback(window_, key_changed);  // Dear ImGui calls it too
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 450");
  }
  ~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  double scale() const { return scale_; }

 private:
  GLFWwindow* window_ = nullptr;
  double scale_ = 1;
};

Image window_picture(GLFWwindow* window) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  Image image = gl::read_picture(0, width, height, GL_BACK);
  for (std::size_t k = 3; k < image.rgba.size(); k += 4) image.rgba[k] = 255;
  return image;
}

class Loop {
 public:
  Loop(Window& window, Session& session, Interface& interface)
      : window_(window), session_(session), interface_(interface), renderer_(640, 360) {}

  // Until the window is closed (true), or the driver has lost what it held (false): a new window can go on.
  bool go() {
    set_style(interface_.dark(), interface_.scale());
    glfwSetWindowUserPointer(window_.handle(), &interface_);
    while (glfwWindowShouldClose(window_.handle()) == 0) {
      const double begin = seconds();
      bool lost = false;
      try {
        if (!turn()) break;
      } catch (const GraphicsError&) {
        lost = glGetGraphicsResetStatus() != GL_NO_ERROR;
        if (!lost) throw;
      }
      if (lost || glGetGraphicsResetStatus() != GL_NO_ERROR) {
        if (recorder_.running()) end_recording();
        return false;
      }
      wait(begin);
    }
    if (recorder_.running()) recorder_.finish();
    return true;
  }

 private:
  // One picture of the window; false where it is to close.
  bool turn() {
    poll();
    draw_water();
    draw_interface();
    if (!answer(interface_.take_requests())) return false;
    glfwSwapBuffers(window_.handle());
    return true;
  }

  bool playing() const { return interface_.status().state == RunState::playing; }
  bool touched() const { return seconds() - last_input_ < busy_after_input; }
  static bool hand_is_down() {
    const bool* down = ImGui::GetIO().MouseDown;
    return down[0] || down[1] || down[2];
  }

  // Waits for input, or for as long as the interface may stay as it is.
  void wait(double begin) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool input = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 || ImGui::IsAnyItemActive() ||
                       io.WantTextInput;
    if (input) last_input_ = seconds();
    const bool busy = recorder_.running() || touched();
    double interval = busy ? busy_interval : idle_interval;
    // With the water's next picture, not just before it.
    if (playing()) interval = std::clamp(water_due_ - begin + 2e-3, busy_interval, busy ? interval : 2 * interval);
    const double left = interval - (seconds() - begin);
    if (busy) {
      if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
      glfwPollEvents();
    } else {
      glfwWaitEventsTimeout(std::max(left, 1e-3));
    }
  }

  void poll() {
    Session::Update update = session_.poll();
    const auto recorded = std::move(update.recorded);
    interface_.take(std::move(update));
    if (!recorder_.running()) return;
    try {
      for (const auto& frame : recorded) recorder_.add(*interface_.cut_open(frame), interface_.view());
      if (interface_.status().scene_number != recorded_scene_) end_recording();
    } catch (const std::exception& error) {
      abandon_recording();
      interface_.say(error.what(), true);
    }
  }

  void abandon_recording() {
    session_.record(0);
    recorder_.abandon();
  }

  void end_recording() {
    session_.record(0);
    const bool wrote = recorder_.finish();
    interface_.say(wrote ? "Wrote " + recorder_.target().string()
                         : "The recording ended before its first frame: nothing written");
  }

  // The newest state, so often that drawing takes its share of the time and no more. Where a picture is slow, that is
  // where a processor draws it, motion is shown in drafts and what stands still in full.
  void draw_water() {
    if (!interface_.frame()) return;
    const double now = seconds();
    const bool is_new = drawn_version_ != interface_.version();
    if (is_new) {
      moving_ = hand_is_down() || now - changed_at_ < still_after;
      changed_at_ = now;
    } else if (now - changed_at_ > still_after) {
      moving_ = false;
    }
    const bool draft = slow_ && (playing() || moving_);
    if (!is_new && (draft || !is_draft_)) return;
    const double due = hand_is_down() ? std::min(water_due_, drawn_at_ + 2 * draw_seconds_) : water_due_;
    if (playing() && now < due) return;
    draw_water(draft ? Renderer::Detail::draft : Renderer::Detail::full);
  }

  void draw_water(Renderer::Detail detail) {
    const auto [width, height] = interface_.picture_size();
    const bool same_size = have_picture_ && width == renderer_.width() && height == renderer_.height();
    double begin = seconds();
    try {
      renderer_.resize(width, height);
      begin = seconds();
      renderer_.render(*interface_.frame(), interface_.view(), detail);
      glFinish();
    } catch (const InputError& error) {
      interface_.say(error.what(), true);
    }
    const double before = drawn_at_;
    drawn_at_ = seconds();
    draw_seconds_ = drawn_at_ - begin;
    if (playing() && drawn_playing_) interface_.drew_water(drawn_at_ - before);
    drawn_playing_ = playing();
    // The first picture of a size pays for its shaders. A quick draft says that a full picture is worth another try.
    is_draft_ = detail == Renderer::Detail::draft;
    if (same_size) slow_ = draw_seconds_ > (is_draft_ ? quick / 4 : quick);
    drawn_version_ = interface_.version();
    have_picture_ = true;
  }

  void draw_interface() {
    const double begin = seconds();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_.handle(), &width, &height);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    interface_.draw(have_picture_ ? renderer_.texture() : 0);
    ImGui::Render();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glClearColor(0.1f, 0.1f, 0.1f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    water_due_ = drawn_at_ + (draw_seconds_ + seconds() - begin) / interface_.drawing_share();
  }

  // Does what was asked for; false where the window is to close.
  bool answer(const Interface::Requests& asked) {
    if (asked.quit) return false;
    if (asked.restyle) {
      set_style(interface_.dark(), interface_.scale());
      ImGui_ImplOpenGL3_DestroyFontsTexture();
      ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    try {
      if (asked.screenshot) save_picture(asked.with_interface);
      if (asked.start_recording && !recorder_.running()) {
        recorded_scene_ = interface_.status().scene_number;
        const auto [width, height] = interface_.picture_size();
        const auto target = asked.as_frames ? interface_.new_file("frames", "") : interface_.new_file("film", "mp4");
        recorder_.start(target, width, height);
        session_.record(Recorder::fps);
        interface_.say("Recording " + target.string() + " while the water runs; press End recording to finish");
      }
      if (asked.stop_recording && recorder_.running()) end_recording();
    } catch (const std::exception& error) {
      interface_.say(error.what(), true);
    }
    return true;
  }

  void save_picture(bool with_interface) {
    if (is_draft_) {
      draw_water(Renderer::Detail::full);
      if (with_interface) draw_interface();
    }
    const auto file = interface_.new_file(with_interface ? "window" : "picture", "png");
    std::filesystem::create_directories(std::filesystem::absolute(file).parent_path());
    write_png(file, with_interface ? window_picture(window_.handle()) : renderer_.read());
    interface_.say("Wrote " + file.string());
  }

  Window& window_;
  Session& session_;
  Interface& interface_;
  Renderer renderer_;
  Recorder recorder_;
  std::int64_t recorded_scene_ = 0;
  std::uint64_t drawn_version_ = 0;
  double drawn_at_ = 0, draw_seconds_ = 0, water_due_ = 0, last_input_ = 0, changed_at_ = 0;
  bool have_picture_ = false, is_draft_ = false, slow_ = false, moving_ = false, drawn_playing_ = false;
};

// Saves the run that its window has lost; how to go on with it, as the end of a sentence.
std::string kept_state(Session& session, Interface& interface) {
  const std::string state = interface.new_file("checkpoint", "curlew").string();
  session.save_checkpoint(state);
  session.finish_tasks();
  if (std::filesystem::exists(state)) return "; the run's state is kept: curlew run --resume " + state;
  for (const Message& message : session.poll().messages) {
    if (message.error) return "; the run's state is lost: " + message.text;
  }
  return "";
}

}  // namespace

int gui_command(const RunOptions& options) {
  // What is wrong with the command line is said before a window opens.
  RunOptions own_options;
  own_options.scene = options.scene.empty() ? "pillars" : options.scene;
  RunOptions changed = options;
  changed.scene = own_options.scene;
  const Scene scene = scene_from(changed), own = scene_from(own_options);
  check_resolution(scene);
  auto window = std::make_unique<Window>();
  Session session(options.threads);
  Interface::Settings settings;
  settings.assets = assets_folder();
  settings.scale = window->scale();
  settings.seed = options.seed;
  Interface interface(session, settings);
  interface.open(changed.scene, scene, own);
  std::vector<double> losses;  // when
  for (;;) {
    try {
      if (Loop(*window, session, interface).go()) return 0;
      losses.push_back(seconds());
      if (losses.size() >= most_losses && losses.back() - losses[losses.size() - most_losses] < 60)
        throw GraphicsError("the graphics driver was reset again and again");
      window.reset();
      window = std::make_unique<Window>();
    } catch (const GraphicsError& error) {
      if (losses.empty()) throw;
      throw GraphicsError(error.what() + kept_state(session, interface));
    }
    constexpr const char* news = "The graphics driver was reset: the window is new, the run is the same";
    interface.say(interface.message().starts_with("Wrote") ? std::string(news) + ". " + interface.message() : news,
                  true);
    std::fprintf(stderr, "%s\n", news);
  }
}

}  // namespace curlew
