// How far a long task is: a bar with the time left on a terminal, a plain line now and then elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace curlew {

class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();

  // `share` done, 0 to 1; `detail` is the rest of the line. Cheap: draws ten times a second at most.
  void show(double share, const std::string& detail);
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_, drawn_ = false;
  Clock::time_point begin_ = Clock::now(), next_ = begin_;
  double first_share_ = -1;
};

// "1:05", "2:03:00".
std::string duration_text(double seconds);

}  // namespace curlew
