// Turns the frames of a session that records into a film.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "render/renderer.h"
#include "render/video.h"

namespace curlew {

class Recorder {
 public:
  static constexpr double fps = 60;  // frames a simulated second, and a second of the film
  bool running() const { return video_ != nullptr; }
  const std::filesystem::path& file() const { return file_; }

  // Throws InputError where there is no ffmpeg or the file cannot be written.
  void start(const std::filesystem::path& file, int width, int height);
  void add(const Frame& frame, const ViewSettings& view);
  // Ends the film; false where it has no frame, and there is no file.
  bool finish();
  // Gives it up.
  void abandon();

 private:
  std::filesystem::path file_;
  std::optional<Renderer> renderer_;
  std::unique_ptr<VideoWriter> video_;
  std::int64_t frames_ = 0;
};

}  // namespace curlew
