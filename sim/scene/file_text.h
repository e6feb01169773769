// A whole file as text, with a clear sentence for everything that can stand at a path instead.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace curlew {

// Reads a regular file of at most `largest` bytes. `what` names what was expected there, as in "a scene file". Throws
// InputError.
std::string read_file(const std::filesystem::path& file, std::uintmax_t largest, const std::string& what);

// Only the checks: the file exists, is a regular file, is not empty and not larger than `largest`. Throws InputError.
void require_file(const std::filesystem::path& file, std::uintmax_t largest, const std::string& what);

}  // namespace curlew
