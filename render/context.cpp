// Off-screen contexts. Two ways are tried, surfaceless first: Mesa offers it on every machine, with or without a GPU.
// The device platform is what vendors' drivers offer instead.
//
// References: EGL 1.5 specification; EGL_MESA_platform_surfaceless; EGL_EXT_device_enumeration and
// EGL_EXT_platform_device; EGL_KHR_no_config_context; EGL_KHR_surfaceless_context.
#include "render/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include "sim/core/error.h"

// Mesa leaks 112 bytes in eglTerminate, which no suppression can name; sanitized builds leave the display open.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CURLEW_KEEP_EGL_OPEN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(leak_sanitizer)
#define CURLEW_KEEP_EGL_OPEN 1
#endif
#endif

namespace curlew {

struct OffscreenContext::Egl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

namespace {

constexpr const char* kInstall =
    "install a driver, on Debian or Ubuntu with: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";

struct Candidate {
  std::string name;
  EGLDisplay display;
};

bool has_word(const char* list, std::string_view word) {
  for (std::string_view rest = list ? list : ""; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

template <class Function>
Function egl_function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// The displays of this machine that need no window system, in the order in which they are tried.
std::vector<Candidate> candidates() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto platform_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  std::vector<Candidate> found;
  if (!platform_display) return found;
  if (has_word(extensions, "EGL_MESA_platform_surfaceless"))
    found.push_back({"EGL surfaceless", platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});

  const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (query_devices && has_word(extensions, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count))
      for (EGLint i = 0; i < count; ++i)
        found.push_back({"EGL device " + std::to_string(i),
                         platform_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr)});
  }
  return found;
}

// EGL_NO_CONFIG where the display allows it: we draw into textures only, so no surface format matters.
EGLConfig any_config(EGLDisplay display) {
  if (has_word(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = EGL_NO_CONFIG_KHR;
  EGLint count = 0;
  eglChooseConfig(display, wanted, &config, 1, &count);
  return config;
}

EGLContext core_context(EGLDisplay display) {
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           4,
                           EGL_CONTEXT_MINOR_VERSION,
                           5,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
#ifndef NDEBUG
                           EGL_CONTEXT_OPENGL_DEBUG,
                           EGL_TRUE,
#endif
                           EGL_NONE};
  return eglCreateContext(display, any_config(display), EGL_NO_CONTEXT, wanted);
}

void close_display([[maybe_unused]] EGLDisplay display) {
#ifndef CURLEW_KEEP_EGL_OPEN
  eglTerminate(display);
#endif
}

std::string gl_string(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

std::string hex(EGLint code) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%04x", static_cast<unsigned>(code));
  return text;
}

// One complaint a thread is enough: the first names the cause.
thread_local std::string complaint;

void GLAD_API_PTR on_message(GLenum, GLenum, GLuint, GLenum severity, GLsizei length, const GLchar* text, const void*) {
  if (severity == GL_DEBUG_SEVERITY_HIGH && complaint.empty())
    complaint.assign(text, length < 0 ? std::string_view(text).size() : static_cast<std::size_t>(length));
}

}  // namespace

OffscreenContext::OffscreenContext() : egl_(std::make_unique<Egl>()) {
  std::string tried;
  for (const Candidate& candidate : candidates()) {
    if (!tried.empty()) tried += ", ";
    tried += candidate.name;
    if (candidate.display == EGL_NO_DISPLAY || !eglInitialize(candidate.display, nullptr, nullptr)) {
      tried += " (no display, EGL error " + hex(eglGetError()) + ")";
      continue;
    }
    const EGLContext context = core_context(candidate.display);
    if (context == EGL_NO_CONTEXT) {
      tried += " (no OpenGL 4.5 core, EGL error " + hex(eglGetError()) + ")";
      close_display(candidate.display);
      continue;
    }
    if (!eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) ||
        gladLoadGL(reinterpret_cast<GLADloadfunc>(eglGetProcAddress)) == 0) {
      tried += " (context cannot be used, EGL error " + hex(eglGetError()) + ")";
      eglDestroyContext(candidate.display, context);
      close_display(candidate.display);
      continue;
    }
    *egl_ = {candidate.display, context};
    info_ = {candidate.name, gl_string(GL_RENDERER), gl_string(GL_VERSION)};
#ifndef NDEBUG
    watch_graphics_errors();
#endif
    return;
  }
  throw GraphicsError(
      "no off-screen OpenGL 4.5 context: tried " +
      (tried.empty() ? std::string("EGL, which offers neither its surfaceless nor its device platform") : tried) +
      "; " + kInstall);
}

OffscreenContext::~OffscreenContext() {
  eglMakeCurrent(egl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(egl_->display, egl_->context);
  close_display(egl_->display);
}

void OffscreenContext::make_current() {
  if (!eglMakeCurrent(egl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl_->context))
    throw GraphicsError("the OpenGL context cannot be made current (EGL error " + hex(eglGetError()) +
                        "): another thread still holds it");
}

void OffscreenContext::release() { eglMakeCurrent(egl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

void watch_graphics_errors() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_message, nullptr);
}

void check_graphics() {
  if (complaint.empty()) return;
  GraphicsError error("OpenGL reported: " + complaint);
  complaint.clear();
  throw error;
}

}  // namespace curlew
