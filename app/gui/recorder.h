// Turns the frames of a session that records into a film, or into a folder of pictures.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "render/frame_writer.h"
#include "render/renderer.h"
#include "render/video.h"

namespace curlew {

class Recorder {
 public:
  static constexpr double fps = 60;  // frames a simulated second, and a second of the film
  bool running() const { return renderer_.has_value(); }
  const std::filesystem::path& target() const { return target_; }

  // A name that ends in .mp4 becomes a film, any other a folder of 000000.png, 000001.png ...
  // Throws InputError where there is no ffmpeg or the file cannot be written.
  void start(const std::filesystem::path& target, int width, int height);
  void add(const Frame& frame, const ViewSettings& view);
  // Ends it; false where it has no frame, and there is nothing. Throws InputError where a picture could not be written.
  bool finish();
  // Gives it up; pictures that were written stay.
  void abandon();

 private:
  std::filesystem::path target_;
  std::optional<Renderer> renderer_;
  std::unique_ptr<VideoWriter> video_;
  std::unique_ptr<FrameWriter> pictures_;
  std::int64_t frames_ = 0;
};

}  // namespace curlew
