// Off-screen contexts: they come up without a display, say what they are, and pass on what the driver complains about.
#include "render/context.h"

#include <glad/gl.h>

#include <catch2/catch.hpp>
#include <thread>

#include "sim/core/error.h"

using namespace curlew;

TEST_CASE("an off-screen context gives OpenGL 4.5 and names its renderer") {
  const OffscreenContext context;
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  CHECK(10 * major + minor >= 45);
  CHECK(context.info().platform.rfind("EGL ", 0) == 0);
  CHECK_FALSE(context.info().renderer.empty());
  CHECK(context.info().version.find("4.") != std::string::npos);
}

TEST_CASE("a context can be made again, and handed to another thread") {
  { const OffscreenContext first; }
  OffscreenContext context;
  context.release();
  bool works = false;
  std::thread([&] {
    context.make_current();
    works = glGetString(GL_VERSION) != nullptr;
    context.release();
  }).join();
  CHECK(works);
  context.make_current();
  CHECK(glGetString(GL_VERSION) != nullptr);
}

TEST_CASE("a complaint of OpenGL becomes an error once") {
  const OffscreenContext context;
  watch_graphics_errors();
  glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_ERROR, 1, GL_DEBUG_SEVERITY_HIGH, -1, "as a test");
  CHECK_THROWS_WITH(check_graphics(), "OpenGL reported: as a test");
  CHECK_NOTHROW(check_graphics());
}
