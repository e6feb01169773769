#include <algorithm>

#include "render/png.h"
#include "sim/core/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "sim/scene/file_text.h"

namespace curlew {

Image read_png(const std::filesystem::path& file) {
  const std::string bytes = read_file(file, 1'000'000'000, "a PNG picture");
  int width = 0, height = 0, channels = 0;
  std::uint8_t* pixels = stbi_load_from_memory(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                               static_cast<int>(bytes.size()), &width, &height, &channels, 4);
  if (pixels == nullptr)
    throw InputError(file.string() + ": is no PNG picture that can be read (" + stbi_failure_reason() + ")");
  Image image(width, height);
  std::copy(pixels, pixels + image.rgba.size(), image.rgba.begin());
  stbi_image_free(pixels);
  return image;
}

}  // namespace curlew
