// The program `curlew`. Exit codes: 0 done; 1 a comparison or a bench gate failed; 2 bad usage, scene or file;
// 3 the simulation diverged; 4 no display or no OpenGL; 130 interrupted.
#include <cstdio>
#include <exception>
#include <new>

#include "app/command_line.h"
#include "sim/core/error.h"

namespace {

int complain(const char* sentence, int code) {
  std::fflush(stdout);
  std::fprintf(stderr, "curlew: %s\n", sentence);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
#if defined(__AVX2__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    return complain("this program was built for processors with AVX2, which this one lacks; build it again here", 2);
  }
#endif
  try {
    const int code = curlew::dispatch(argc, argv);
    if (std::fflush(stdout) != 0) return complain("cannot write to standard output", 2);
    return code;
  } catch (const curlew::InputError& error) {
    return complain(error.what(), 2);
  } catch (const curlew::DivergedError& error) {
    return complain(error.what(), 3);
  } catch (const curlew::GraphicsError& error) {
    return complain(error.what(), 4);
  } catch (const std::bad_alloc&) {
    return complain("memory ran out; use a larger particle radius", 2);
  } catch (const std::exception& error) {
    return complain(error.what(), 2);
  }
}
