#include "app/gui/recorder.h"

#include <cstdio>
#include <utility>

namespace curlew {

void Recorder::start(const std::filesystem::path& target, int width, int height) {
  abandon();
  const bool film = target.extension() == ".mp4";
  std::filesystem::create_directories(std::filesystem::absolute(target).parent_path());
  if (film) {
    width += width % 2;  // H.264 wants even sides
    height += height % 2;
  }
  Renderer renderer(width, height);
  if (film) {
    video_ = std::make_unique<VideoWriter>(target, width, height, fps);
  } else {
    pictures_ = std::make_unique<FrameWriter>();
  }
  renderer_.emplace(std::move(renderer));
  target_ = target;
  frames_ = 0;
}

void Recorder::add(const Frame& frame, const ViewSettings& view) {
  Image image = renderer_->draw(frame, view);
  if (video_) {
    video_->write(image);
  } else {
    std::filesystem::create_directories(target_);
    char name[24];
    std::snprintf(name, sizeof name, "%06lld.png", static_cast<long long>(frames_));
    pictures_->write(target_ / name, std::move(image));
  }
  ++frames_;
}

bool Recorder::finish() {
  const auto video = std::move(video_);
  const auto pictures = std::move(pictures_);
  renderer_.reset();
  if (frames_ == 0) return false;
  if (video) video->finish();
  if (pictures) pictures->finish();
  return true;
}

void Recorder::abandon() {
  video_.reset();
  pictures_.reset();
  renderer_.reset();
}

}  // namespace curlew
