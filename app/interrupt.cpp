#include "app/interrupt.h"

#include <atomic>
#include <csignal>

namespace curlew {
namespace {

// A signal handler can reach nothing but a global.
std::atomic<bool> flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int signal) {
  if (flag.exchange(true)) std::signal(signal, SIG_DFL), std::raise(signal);
}

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() { return flag; }

}  // namespace curlew
