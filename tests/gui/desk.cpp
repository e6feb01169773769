#include "tests/gui/desk.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>

#include "app/gui/style.h"
#include "render/png.h"

namespace curlew::test {

Desk::Desk(const std::filesystem::path& out, int width, int height, double scale) : width_(width), height_(height) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.0f / 60;
  io.MousePos = {-1, -1};
  ImGui_ImplOpenGL3_Init("#version 450");
  colour_ = gl::make_texture(GL_RGBA8, width, height);
  const GLuint attachments[] = {colour_};
  target_ = gl::make_framebuffer(attachments);
  Interface::Settings settings;
  settings.assets = CURLEW_ASSETS_DIR;
  settings.out = out;
  settings.scale = scale;
  interface_ = std::make_unique<Interface>(session, settings);
  renderer_ = std::make_unique<Renderer>(64, 64);
  set_style(false, scale);
}

Desk::~Desk() {
  renderer_.reset();
  target_ = {};
  colour_ = {};
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Desk::draw() {
  Session::Update update = session.poll();
  parameters = update.parameters;
  interface_->take(std::move(update));
  const auto [width, height] = interface_->picture_size();
  unsigned texture = 0;
  if (interface_->frame()) {
    if (drawn_ != interface_->version()) {
      renderer_->resize(width, height);
      renderer_->render(*interface_->frame(), interface_->view());
      drawn_ = interface_->version();
    }
    texture = renderer_->texture();
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  interface_->draw(texture);
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glViewport(0, 0, width_, height_);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  requests = interface_->take_requests();
}

void Desk::settle() {
  session.finish_tasks();
  draw();
  session.finish_tasks();  // a scene that stands makes the interface ask for more
  draw();
}

void Desk::move_to(float x, float y) {
  ImGui::GetIO().MousePos = {x, y};
  draw();
  draw();
}

void Desk::press_at(float x, float y) {
  move_to(x, y);
  ImGui::GetIO().MouseDown[0] = true;
  draw();
}

void Desk::release() {
  ImGui::GetIO().MouseDown[0] = false;
  draw();
}

void Desk::click(std::string_view widget) {
  const auto box = interface_->place(widget);
  move_to(0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3]));
  ImGui::GetIO().MouseDown[0] = true;
  draw();
  ImGui::GetIO().MouseDown[0] = false;
  draw();
  // A request stands in the picture in which the button came up.
  const Interface::Requests asked = requests;
  draw();
  requests = asked;
}

void Desk::double_click(std::string_view widget) {
  const auto box = interface_->place(widget);
  move_to(0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3]));
  for (int k = 0; k < 2; ++k) {
    ImGui::GetIO().MouseDown[0] = true;
    draw();
    ImGui::GetIO().MouseDown[0] = false;
    draw();
  }
}

void Desk::drag(std::string_view widget, float from, float to) {
  const auto box = interface_->place(widget);
  const float y = 0.5f * (box[1] + box[3]);
  move_to(box[0] + from * (box[2] - box[0]), y);
  ImGui::GetIO().MouseDown[0] = true;
  draw();
  for (int k = 1; k <= 5; ++k)
    move_to(box[0] + (from + (to - from) * static_cast<float>(k) / 5) * (box[2] - box[0]), y);
  ImGui::GetIO().MouseDown[0] = false;
  draw();
}

void Desk::type(std::string_view widget, const char* text) {
  ImGui::GetIO().KeyCtrl = true;
  click(widget);
  ImGui::GetIO().KeyCtrl = false;
  draw();
  for (const char* c = text; *c != 0; ++c) {
    ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(*c));
    draw();
  }
}

void Desk::drag_in_picture(float dx, float dy, int mouse_button) {
  const auto box = interface_->place("picture");
  const float x = 0.5f * (box[0] + box[2]), y = 0.5f * (box[1] + box[3]);
  move_to(x, y);
  ImGui::GetIO().MouseDown[mouse_button] = true;
  draw();
  move_to(x + dx, y + dy);
  ImGui::GetIO().MouseDown[mouse_button] = false;
  draw();
}

void Desk::wheel(float notches) {
  const auto box = interface_->place("picture");
  wheel_at(0.5f * (box[0] + box[2]), 0.5f * (box[1] + box[3]), notches);
}

void Desk::wheel_at(float x, float y, float notches) {
  move_to(x, y);
  ImGui::GetIO().MouseWheel = notches;
  draw();
  ImGui::GetIO().MouseWheel = 0;
  draw();
}

void Desk::key(int key, bool ctrl) {
  interface_->press(key, ctrl, false);
  draw();
}

void Desk::open(const std::string& scene) {
  interface_->open(scene);
  settle();
}

void Desk::restyle(bool dark, double scale) {
  set_style(dark, scale);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Desk::keep(const std::string& name) {
  if (const char* folder = std::getenv("CURLEW_KEEP_WINDOWS")) {
    write_png(std::filesystem::path(folder) / (name + ".png"), picture());
  }
}

Image Desk::picture() {
  Image image = gl::read_picture(target_, width_, height_);
  for (std::size_t k = 3; k < image.rgba.size(); k += 4) image.rgba[k] = 255;
  return image;
}

}  // namespace curlew::test
