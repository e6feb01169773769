#include "sim/scene/file_text.h"

#include <fstream>
#include <system_error>

#include "sim/core/error.h"

namespace curlew {

void require_file(const std::filesystem::path& file, std::uintmax_t largest, const std::string& what) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const auto fail = [&](const std::string& found) {
    throw InputError(file.string() + ": " + found + ", expected " + what);
  };
  if (status.type() == std::filesystem::file_type::not_found) fail("there is no such file");
  if (status.type() == std::filesystem::file_type::directory) fail("this is a folder");
  if (error) fail("cannot be read (" + error.message() + ")");
  if (status.type() != std::filesystem::file_type::regular) fail("this is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) fail("cannot be read (" + error.message() + ")");
  if (size == 0) fail("the file is empty");
  if (size > largest) {
    fail("the file has " + std::to_string(size) + " bytes, more than the " + std::to_string(largest) + " allowed");
  }
}

std::string read_file(const std::filesystem::path& file, std::uintmax_t largest, const std::string& what) {
  require_file(file, largest, what);
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(std::filesystem::file_size(file)), '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(text.size()))) {
    throw InputError(file.string() + ": cannot be read, expected " + what);
  }
  return text;
}

}  // namespace curlew
