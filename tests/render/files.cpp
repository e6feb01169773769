// PNG files and the thread that writes them.
#include <stb/stb_image.h>

#include <catch2/catch.hpp>

#include "render/frame_writer.h"
#include "render/png.h"
#include "tests/io/temporary_folder.h"

using namespace curlew;
using namespace curlew::test;

namespace {

Image pattern(int width, int height, bool opaque) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* p = image.at(x, y);
      p[0] = static_cast<std::uint8_t>(7 * x + 3 * y);
      p[1] = static_cast<std::uint8_t>(x * y);
      p[2] = static_cast<std::uint8_t>(x ^ y);
      p[3] = opaque ? 255 : static_cast<std::uint8_t>(5 * y);
    }
  return image;
}

Image decoded(const std::string& png, int& channels) {
  int width = 0, height = 0;
  stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()), static_cast<int>(png.size()),
                                          &width, &height, &channels, 4);
  REQUIRE(pixels);
  Image image(width, height);
  std::copy_n(pixels, image.rgba.size(), image.rgba.data());
  stbi_image_free(pixels);
  return image;
}

}  // namespace

TEST_CASE("a PNG file holds the very pixels") {
  const TemporaryFolder folder;
  for (const bool opaque : {true, false}) {
    const Image image = pattern(67, 41, opaque);
    write_png(folder / "a.png", image);
    int channels = 0;
    CHECK(decoded(file_text(folder / "a.png"), channels).rgba == image.rgba);
    CHECK(channels == (opaque ? 3 : 4));
  }
  CHECK(folder.contents() == std::vector<std::string>{"a.png"});
}

TEST_CASE("a file that cannot be written is named with the system's reason") {
  CHECK(input_error([] { write_png("/dev/null/x.png", pattern(4, 4, true)); }) ==
        "cannot write /dev/null/x.png: Not a directory");
  CHECK(input_error([] { write_png("/no such folder/x.png", pattern(4, 4, true)); }) ==
        "cannot write /no such folder/x.png: No such file or directory");
}

TEST_CASE("a full disk leaves no half file") {
  const TemporaryFolder folder;
  // What is written beside, under this very name, goes to a device that is always full.
  std::filesystem::create_symlink("/dev/full", folder / "x.png.part");
  CHECK(input_error([&] { write_png(folder / "x.png", pattern(64, 64, true)); }) ==
        "cannot write " + (folder / "x.png") + ": No space left on device");
  CHECK(folder.contents().empty());
}

TEST_CASE("the writer writes every picture, in order, and is done when it says so") {
  const TemporaryFolder folder;
  FrameWriter writer(2);
  for (int i = 0; i < 12; ++i) writer.write(folder / (std::to_string(100 + i) + ".png"), pattern(50 + i, 20, true));
  writer.finish();
  CHECK(folder.contents().size() == 12);
  int channels = 0;
  CHECK(decoded(file_text(folder / "111.png"), channels).width == 61);
}

TEST_CASE("the writer's first error comes back at the next call and at the end") {
  const TemporaryFolder folder;
  FrameWriter writer(1);
  writer.write("/dev/null/first.png", pattern(4, 4, true));
  const std::string expected = "cannot write /dev/null/first.png: Not a directory";
  CHECK(input_error([&] { writer.finish(); }) == expected);
  CHECK(input_error([&] { writer.write(folder / "later.png", pattern(4, 4, true)); }) == expected);
  CHECK(folder.contents().empty());
}

TEST_CASE("a writer that goes away still writes what waits") {
  const TemporaryFolder folder;
  {
    FrameWriter writer(8);
    for (int i = 0; i < 5; ++i) writer.write(folder / (std::to_string(i) + ".png"), pattern(100, 100, true));
  }
  CHECK(folder.contents().size() == 5);
}
