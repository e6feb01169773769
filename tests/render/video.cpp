// Videos: a film that ffmpeg itself can read back, and a clear sentence for each way in which there is none.
#include "render/video.h"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/io/file_size_limit.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

Image grey(int width, int height, int level) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    image.rgba[i] = i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(level);
  return image;
}

// PATH for the length of a test.
struct Path {
  std::string before = std::getenv("PATH") ? std::getenv("PATH") : "";
  explicit Path(const std::string& path) { ::setenv("PATH", path.c_str(), 1); }
  ~Path() { ::setenv("PATH", before.c_str(), 1); }
};

// A stand-in for ffmpeg.
void put_program(const TemporaryFolder& folder, const std::string& script) {
  put_file(folder / "bin/ffmpeg", "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(folder / "bin/ffmpeg", std::filesystem::perms::owner_all);
}

}  // namespace

TEST_CASE("a video holds the frames that were written") {
  if (!video_available()) {
    WARN("no ffmpeg here: not tested");
    return;
  }
  const TemporaryFolder folder;
  const std::string file = folder / "a film's name; \"quoted\".mp4";
  VideoWriter video(file, 64, 48, 25);
  for (int i = 0; i < 30; ++i) video.write(grey(64, 48, 8 * i));
  CHECK_FALSE(std::filesystem::exists(file));
  video.finish();
  CHECK(folder.contents().size() == 1);

  const std::string raw = folder / "raw";
  const std::string command = "ffmpeg -loglevel error -i '" + folder.path() +
                              "/a film'\\''s name; \"quoted\".mp4' -f rawvideo -pix_fmt gray " + raw;
  REQUIRE(std::system(command.c_str()) == 0);
  const std::string levels = file_text(raw);
  REQUIRE(levels.size() == 30u * 64 * 48);
  for (const std::size_t frame : {0u, 15u, 29u}) {
    const int seen = static_cast<unsigned char>(levels[frame * 64 * 48 + 24 * 64 + 32]);
    CHECK(std::abs(seen - 8 * static_cast<int>(frame)) <= 4);
  }
}

TEST_CASE("a video without ffmpeg says what to install") {
  const TemporaryFolder folder;
  const Path nowhere(folder.path());
  CHECK_FALSE(video_available());
  CHECK(input_error([&] { VideoWriter(folder / "a.mp4", 64, 48, 25); }) ==
        "cannot write the video " + (folder / "a.mp4") +
            ": the program ffmpeg was not found on PATH; install it, on Debian or Ubuntu with: apt-get install ffmpeg, "
            "or write PNG frames instead");
  CHECK(folder.contents().empty());
}

TEST_CASE("an ffmpeg that dies is an error with its last words, not a signal") {
  const TemporaryFolder folder;
  put_program(folder, "echo warming up >&2\necho 'no such encoder' >&2\nexit 3");
  const Path path(folder / "bin");
  VideoWriter video(folder / "a.mp4", 640, 480, 25);
  const std::string said = input_error([&] {
    for (int i = 0; i < 100; ++i) video.write(grey(640, 480, 0));
  });
  CHECK(said == "cannot write the video " + (folder / "a.mp4") + ": ffmpeg gave up: no such encoder");
  CHECK(input_error([&] { video.write(grey(640, 480, 0)); }) ==
        "the video " + (folder / "a.mp4") + " has already ended");
  CHECK_FALSE(std::filesystem::exists(folder / "a.mp4"));
  CHECK_FALSE(std::filesystem::exists(folder / "a.mp4.part"));
}

TEST_CASE("an ffmpeg that fails at the end is an error too") {
  const TemporaryFolder folder;
  put_program(folder, "while read -r line; do :; done\nexit 1");
  const Path path(folder / "bin");
  VideoWriter video(folder / "a.mp4", 64, 48, 25);
  video.write(grey(64, 48, 0));
  CHECK(input_error([&] { video.finish(); }) ==
        "cannot write the video " + (folder / "a.mp4") + ": ffmpeg gave up: it gave no reason (exit status 1)");
  CHECK(folder.contents() == std::vector<std::string>{"bin", "bin/ffmpeg"});
}

TEST_CASE("a film that does not fit on the disk is an error, although ffmpeg 5 would end well") {
  if (!video_available()) {
    WARN("no ffmpeg here: not tested");
    return;
  }
  const TemporaryFolder folder;
  const std::string said = input_error([&] {
    const FileSizeLimit limit(1000);  // ffmpeg inherits it
    VideoWriter video(folder / "a.mp4", 64, 48, 25);
    for (int i = 0; i < 5; ++i) video.write(grey(64, 48, 50 * i));
    video.finish();
  });
  CHECK(said.starts_with("cannot write the video " + (folder / "a.mp4") + ": ffmpeg gave up: "));
  CHECK(said.ends_with("File too large"));
  CHECK(folder.contents().empty());
}

TEST_CASE("an ffmpeg left over from a run that was killed does not write into the next film") {
  const TemporaryFolder folder;
  put_program(folder, "for last; do :; done; cat >/dev/null; echo film >\"${last#file:}\"");
  const Path path(folder / "bin:" + std::getenv("PATH"));
  std::ofstream left_over(folder / "a.mp4.part");
  VideoWriter video(folder / "a.mp4", 64, 48, 25);
  video.write(grey(64, 48, 0));
  video.finish();
  left_over << "of another film" << std::flush;
  CHECK(file_text(folder / "a.mp4") == "film\n");
}

TEST_CASE("a video given up leaves nothing") {
  const TemporaryFolder folder;
  put_program(folder, "while read -r line; do :; done");
  const Path path(folder / "bin");
  { VideoWriter video(folder / "a.mp4", 64, 48, 25); }
  CHECK(folder.contents() == std::vector<std::string>{"bin", "bin/ffmpeg"});
}

TEST_CASE("sizes and places that a video cannot have are named") {
  CHECK(input_error([] { VideoWriter("a.mp4", 641, 480, 25); }) ==
        "a video needs an even width and height, and 641x480 is not: the nearest that fits is 642x480");
  CHECK(input_error([] { VideoWriter("a.mp4", 640, 480, 0); }) == "a video needs a positive number of frames a second");
  CHECK(input_error([] { VideoWriter("/dev/null/a.mp4", 64, 48, 25); }) ==
        "cannot write /dev/null/a.mp4: Not a directory");
}
