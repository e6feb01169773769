// PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "render/image.h"

namespace curlew {

// Without an alpha channel where every pixel is opaque.
std::vector<std::uint8_t> encode_png(const Image& image);

// Whole or not at all: written beside, then renamed. Throws InputError with the file's name and the system's reason.
void write_png(const std::filesystem::path& file, const Image& image);

// Throws InputError where the file is no PNG, or damaged.
Image read_png(const std::filesystem::path& file);

}  // namespace curlew
