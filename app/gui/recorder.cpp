#include "app/gui/recorder.h"

namespace curlew {

void Recorder::start(const std::filesystem::path& file, int width, int height) {
  std::filesystem::create_directories(std::filesystem::absolute(file).parent_path());
  width += width % 2;  // H.264 wants even sides
  height += height % 2;
  video_ = std::make_unique<VideoWriter>(file, width, height, fps);
  renderer_.emplace(width, height);
  file_ = file;
  frames_ = 0;
}

void Recorder::add(const Frame& frame, const ViewSettings& view) {
  video_->write(renderer_->draw(frame, view));
  ++frames_;
}

bool Recorder::finish() {
  const auto video = std::move(video_);
  renderer_.reset();
  if (frames_ == 0) return false;
  video->finish();
  return true;
}

void Recorder::abandon() {
  video_.reset();
  renderer_.reset();
}

}  // namespace curlew
