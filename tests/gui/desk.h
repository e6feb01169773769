// A window without a display: the interface drawn into an off-screen picture, and a hand that moves mouse and keys.
#pragma once

#include <filesystem>
#include <string>

#include "app/gui/interface.h"
#include "app/gui/recorder.h"
#include "app/session.h"
#include "render/context.h"
#include "render/gl.h"
#include "render/image.h"
#include "render/renderer.h"

namespace curlew::test {

class Desk {
 public:
  explicit Desk(const std::filesystem::path& out, int width = 1280, int height = 720, double scale = 1);
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  // One round of the window's loop. settle() goes round until the run has done what it was told and that is drawn.
  void draw();
  void settle();

  void move_to(float x, float y);
  void press_at(float x, float y);
  void release();
  void click(std::string_view widget);
  void double_click(std::string_view widget);
  // Presses on the widget at one fraction of its width and lets go at another.
  void drag(std::string_view widget, float from, float to);
  // Ctrl-click, then the characters; the number counts when something else is clicked.
  void type(std::string_view widget, const char* text);
  void drag_in_picture(float dx, float dy, int mouse_button = 0);
  void wheel(float notches);  // over the picture
  void wheel_at(float x, float y, float notches);
  void key(int key, bool ctrl = false);
  void open(const std::string& scene);
  void restyle(bool dark, double scale);

  Image picture();  // of the whole window
  // For eyes: CURLEW_KEEP_WINDOWS=folder keeps the picture.
  void keep(const std::string& name);

  Session session;
  Interface& interface() { return *interface_; }
  Interface::Requests requests;  // of the last draw()
  Parameters parameters;         // that the solver read at the last draw()

 private:
  OffscreenContext context_;
  int width_, height_;
  std::uint64_t drawn_ = 0;
  gl::Texture colour_;
  gl::Framebuffer target_;
  std::unique_ptr<Interface> interface_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace curlew::test
