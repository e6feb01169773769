#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace curlew {

std::string duration_text(double seconds) {
  const long s = std::max(0L, static_cast<long>(seconds + 0.5));
  char text[64];
  if (s < 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  }
  return text;
}

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() { finish(); }

void Progress::show(double share, const std::string& detail) {
  const auto now = Clock::now();
  if (first_share_ < 0) first_share_ = share;
  if (quiet_ || (now < next_ && share < 1)) return;
  next_ = now + (terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(10));
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const double done = share - first_share_;
  const std::string left = done > 0 && elapsed > 0.5 ? duration_text(elapsed * (1 - share) / done) + " left" : "";
  if (terminal_) {
    constexpr int width = 30;
    const int full = static_cast<int>(share * width);
    std::fprintf(stderr, "\r\033[K[%s%s] %3.0f %%  %s  %s", std::string(static_cast<std::size_t>(full), '#').c_str(),
                 std::string(static_cast<std::size_t>(width - full), '.').c_str(), 100 * share, detail.c_str(),
                 left.c_str());
    drawn_ = true;
  } else {
    std::fprintf(stderr, "%3.0f %%  %s  %s\n", 100 * share, detail.c_str(), left.c_str());
  }
}

void Progress::finish() {
  if (drawn_) std::fprintf(stderr, "\n");
  drawn_ = false;
}

}  // namespace curlew
