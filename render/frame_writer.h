// Writes pictures while the next one is being made.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "render/image.h"

namespace curlew {

// One thread that encodes and writes PNG files in the order in which they come. A file appears whole or not at all.
class FrameWriter {
 public:
  // Keeps at most this many pictures waiting; write() then waits for room.
  explicit FrameWriter(std::size_t most_waiting = 4);
  // Writes what waits; an error that nobody asked for is lost here, so call finish() first.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Throws the InputError of the first picture that could not be written, now or earlier; nothing is written after it.
  void write(std::filesystem::path file, Image image);
  // Waits until all is written; throws like write().
  void finish();

 private:
  struct Job {
    std::filesystem::path file;
    Image image;
  };
  void work();
  void rethrow() const;

  const std::size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  bool busy_ = false, closing_ = false;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace curlew
