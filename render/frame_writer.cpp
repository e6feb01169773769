#include "render/frame_writer.h"

#include <algorithm>
#include <utility>

#include "render/png.h"

namespace curlew {

FrameWriter::FrameWriter(std::size_t most_waiting)
    : most_waiting_(std::max<std::size_t>(1, most_waiting)), thread_([this] { work(); }) {}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameWriter::rethrow() const {
  if (error_) std::rethrow_exception(error_);
}

void FrameWriter::write(std::filesystem::path file, Image image) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return error_ || waiting_.size() < most_waiting_; });
  rethrow();
  waiting_.push_back({std::move(file), std::move(image)});
  changed_.notify_all();
}

void FrameWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return error_ || (waiting_.empty() && !busy_); });
  rethrow();
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Job job = std::move(waiting_.front());
    waiting_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr error;
    try {
      write_png(job.file, job.image);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    if (error) {
      error_ = error;
      waiting_.clear();
    }
    changed_.notify_all();
  }
}

}  // namespace curlew
