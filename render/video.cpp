#include "render/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/core/error.h"

extern char** environ;

namespace curlew {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) close(fd);
  }
};

// Starts ffmpeg with the given files as its input, output and error output. Returns an error number.
int start(std::vector<std::string> words, int input, int output, int errors, pid_t& process) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
  // A process group of its own: Ctrl-C is for us, and we then let ffmpeg end its file in peace.
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawnp(&process, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

int status_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

std::string last_line(std::FILE* file) {
  std::rewind(file);
  std::string line, last;
  std::array<char, 512> text{};
  while (std::fgets(text.data(), static_cast<int>(text.size()), file)) {
    line = text.data();
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
    if (!line.empty()) last = line;
  }
  return last;
}

// Both ends are closed in every child but the one that is given it, or ffmpeg would never see the end of its input.
void socket_pair(Descriptor& ours, Descriptor& theirs) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw InputError("cannot open a pipe to ffmpeg: " + reason(errno));
  ours.fd = ends[0];
  theirs.fd = ends[1];
}

}  // namespace

bool video_available() {
  const Descriptor nothing{open("/dev/null", O_RDWR | O_CLOEXEC)};
  pid_t process = -1;
  if (nothing.fd < 0 || start({"ffmpeg", "-version"}, nothing.fd, nothing.fd, nothing.fd, process) != 0) return false;
  const int status = status_of(process);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

VideoWriter::VideoWriter(std::filesystem::path file, int width, int height, double frames_per_second)
    : file_(std::move(file)), part_(file_), width_(width), height_(height), words_(nullptr, std::fclose) {
  part_ += ".part";
  if (width < 2 || height < 2 || width % 2 || height % 2)
    throw InputError("a video needs an even width and height, and " + std::to_string(width) + "x" +
                     std::to_string(height) + " is not: the nearest that fits is " +
                     std::to_string(std::max(2, width + width % 2)) + "x" +
                     std::to_string(std::max(2, height + height % 2)));
  if (!(frames_per_second > 0) || !std::isfinite(frames_per_second))
    throw InputError("a video needs a positive number of frames a second");

  words_.reset(std::tmpfile());
  const Descriptor nothing{open("/dev/null", O_RDWR | O_CLOEXEC)};
  if (!words_ || nothing.fd < 0) throw InputError("cannot open a temporary file for ffmpeg: " + reason(errno));
  Descriptor ours, theirs;
  socket_pair(ours, theirs);
  // The ffmpeg of a run that was killed just now may still be writing: it keeps its own file, and loses the name.
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  // ffmpeg would say less clearly that the file cannot be written.
  const Descriptor part{open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
  if (part.fd < 0) throw InputError("cannot write " + file_.string() + ": " + reason(errno));

  const std::string colours = "scale=in_range=full:out_range=tv:out_color_matrix=bt709,format=yuv420p";
  const int error = start({"ffmpeg",
                           "-hide_banner",
                           "-loglevel",
                           "error",
                           "-nostdin",
                           "-xerror",  // or ffmpeg 5 ends well on a full disk, with half a film
                           "-y",
                           "-f",
                           "rawvideo",
                           "-pixel_format",
                           "rgba",
                           "-video_size",
                           std::to_string(width) + "x" + std::to_string(height),
                           "-framerate",
                           std::to_string(frames_per_second),
                           "-i",
                           "pipe:0",
                           "-vf",
                           colours,
                           "-c:v",
                           "libx264",
                           "-preset",
                           "medium",
                           "-crf",
                           "18",
                           "-color_range",
                           "tv",
                           "-colorspace",
                           "bt709",
                           "-color_primaries",
                           "bt709",
                           "-color_trc",
                           "iec61966-2-1",
                           "-movflags",
                           "+frag_keyframe+empty_moov",
                           "-f",
                           "mp4",
                           "file:" + part_.string()},
                          theirs.fd, nothing.fd, fileno(words_.get()), process_);
  if (error != 0) {
    process_ = -1;
    std::filesystem::remove(part_);
    throw InputError("cannot write the video " + file_.string() + ": the program ffmpeg " +
                     (error == ENOENT ? "was not found on PATH; install it, on Debian or Ubuntu with: apt-get install "
                                        "ffmpeg, or write PNG frames instead"
                                      : "cannot be started (" + reason(error) + ")"));
  }
  pipe_ = std::exchange(ours.fd, -1);
}

VideoWriter::~VideoWriter() {
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  end();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

int VideoWriter::end() {
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  return status_of(std::exchange(process_, -1));
}

void VideoWriter::fail(int status) {
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  std::string said = last_line(words_.get());
  if (said.empty())
    said = WIFSIGNALED(status) ? "it was ended by signal " + std::to_string(WTERMSIG(status))
                               : "it gave no reason (exit status " + std::to_string(WEXITSTATUS(status)) + ")";
  throw InputError("cannot write the video " + file_.string() + ": ffmpeg gave up: " + said);
}

void VideoWriter::write(const Image& image) {
  if (image.width != width_ || image.height != height_)
    throw InputError("the video " + file_.string() + " has frames of " + std::to_string(width_) + "x" +
                     std::to_string(height_) + ", and one came with " + std::to_string(image.width) + "x" +
                     std::to_string(image.height));
  if (pipe_ < 0) throw InputError("the video " + file_.string() + " has already ended");
  // A socket instead of a pipe: only there can a writer ask for an error instead of SIGPIPE when nobody reads.
  for (std::size_t sent = 0; sent < image.rgba.size();) {
    const ssize_t n = send(pipe_, image.rgba.data() + sent, image.rgba.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(end());
    sent += static_cast<std::size_t>(n);
  }
}

void VideoWriter::finish() {
  if (process_ < 0) return;
  const int status = end();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(status);
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw InputError("cannot write " + file_.string() + ": " + error.message());
}

}  // namespace curlew
