// MP4 video through the program ffmpeg, which is looked for on PATH at run time.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "render/image.h"

namespace curlew {

// True where ffmpeg can be started: for `curlew doctor`.
bool video_available();

// H.264 (libx264, yuv420p, BT.709), fragmented: a film whose run is killed still plays up to there. Frames go to
// <file>.part until finish() renames it. All errors are InputError, one sentence: ffmpeg missing, ffmpeg's own last
// words, odd sizes, a file that cannot be written.
class VideoWriter {
 public:
  VideoWriter(std::filesystem::path file, int width, int height, double frames_per_second);
  // Without finish() the film is given up and its part removed.
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  void write(const Image& image);
  // Waits for ffmpeg to end the file.
  void finish();

 private:
  int end();  // closes the pipe, waits for ffmpeg, returns what waitpid says
  [[noreturn]] void fail(int status);

  std::filesystem::path file_, part_;
  int width_, height_;
  pid_t process_ = -1;
  int pipe_ = -1;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> words_;  // what ffmpeg says
};

}  // namespace curlew
