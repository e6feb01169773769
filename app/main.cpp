// The program `curlew`. Exit codes: 0 done; 1 a comparison or a bench gate failed; 2 bad usage, scene or file;
// 3 the simulation diverged; 4 no display or no OpenGL; 130 interrupted.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include "app/command_line.h"
#include "sim/core/error.h"

namespace {

// One line, whatever the names that the sentence quotes hold.
int complain(std::string sentence, int code) {
  for (char& c : sentence) c = static_cast<unsigned char>(c) < ' ' ? '?' : c;
  std::fflush(stdout);
  std::fprintf(stderr, "curlew: %s\n", sentence.c_str());
  return code;
}

// A standard stream that the caller closed would lend its number, and what we print, to the next file that we open. So
// something stands in for it that cannot be written to, and that says so.
void fill_standard_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

// Threads that wait must sleep: where another process wants a core, spinning ones made a step three times slower, and
// on an idle machine they gain nothing that could be measured. OpenMP reads this before main(), so start once more with
// it.
void let_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 0);
  execv("/proc/self/exe", argv);  // where this fails, go on as we are
}

}  // namespace

int main(int argc, char** argv) {
#if defined(__AVX2__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    return complain("this program was built for processors with AVX2, which this one lacks; build it again here", 2);
  }
#endif
  fill_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond `ulimit -f` is an error of write(), as on a full disk
  let_threads_sleep(argv);
  try {
    const int code = curlew::dispatch(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) return complain("cannot write to standard output", 2);
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
