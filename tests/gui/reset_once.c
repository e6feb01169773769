// Loaded before GLFW: says once, as soon as the file $CURLEW_RESET_FILE is there, that the OpenGL context is lost. No
// software rasteriser ever loses one by itself.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static unsigned reset_status(void) {
  static int said = 0;
  const char* file = getenv("CURLEW_RESET_FILE");
  if (said || file == NULL || access(file, F_OK) != 0) return 0;
  said = 1;
  return 0x8255;  // GL_UNKNOWN_CONTEXT_RESET
}

typedef void (*Function)(void);

Function glfwGetProcAddress(const char* name) {
  if (strcmp(name, "glGetGraphicsResetStatus") == 0) return (Function)reset_status;
  static Function (*next)(const char*) = NULL;
  if (next == NULL) *(void**)&next = dlsym(RTLD_NEXT, "glfwGetProcAddress");
  return next(name);
}
