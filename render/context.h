// An OpenGL 4.5 core context without a window or a display, through EGL.
#pragma once

#include <memory>
#include <string>

namespace curlew {

// What draws: for `curlew doctor` and run.json.
struct GraphicsInfo {
  std::string platform;  // "EGL surfaceless", "EGL device 0"
  std::string renderer;  // "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;   // "4.5 (Core Profile) Mesa 22.3.6"
};

// Current on the thread that makes it. Everything that draws (Renderer) must be gone before it.
class OffscreenContext {
 public:
  // Throws GraphicsError that says what was tried and what to install.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  const GraphicsInfo& info() const { return info_; }

  // A context serves one thread at a time: release it on one before another makes it current.
  void make_current();
  void release();

 private:
  struct Egl;
  std::unique_ptr<Egl> egl_;
  GraphicsInfo info_;
};

// Turns OpenGL's own complaints of high severity into GraphicsError at the next check_graphics(). Called by
// OffscreenContext in debug builds; a window's context may call it too.
void watch_graphics_errors();

// Throws what the driver complained about since the last call, if anything. A no-op where nothing watches.
void check_graphics();

}  // namespace curlew
