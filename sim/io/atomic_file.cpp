#include "sim/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "sim/core/error.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;

// Small writes (headers, short records) are gathered; large ones pass by.
constexpr std::size_t buffer_bytes = std::size_t{1} << 18;

// The first ancestor of a path that is a file where a folder is needed, or empty.
std::string file_among_parents(const fs::path& path) {
  fs::path ancestor;
  for (const fs::path& part : path.parent_path()) {
    ancestor /= part;
    std::error_code ignored;
    const fs::file_status status = fs::status(ancestor, ignored);
    if (fs::exists(status) && !fs::is_directory(status)) return ancestor.string();
  }
  return {};
}

// A name that nobody else writes to: two programs with the same --out must not mix their bytes.
int open_beside(const std::string& path, std::string& temporary) {
  for (int n = 0; n < 1000; ++n) {
    temporary = path + std::string(unfinished_suffix) + std::to_string(n);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

}  // namespace

int write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

std::string write_error(const std::string& path, int error) {
  const std::string sentence = "cannot write " + path + ": ";
  if (const std::string file = file_among_parents(path); !file.empty()) {
    return sentence + file + " is a file, not a folder; choose another folder";
  }
  const bool full = error == ENOSPC || error == EDQUOT;
  return sentence + std::generic_category().message(error) + (full ? "; free some space or" : ";") +
         " choose another folder";
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  // Renaming onto /dev/null would replace the device, for everybody.
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path_, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_symlink(status)) {
    throw InputError("cannot write " + path_ + ": it is " +
                     (fs::is_directory(status) ? "a folder" : "not a regular file") + "; choose another folder");
  }
  error.clear();  // that there is no such file yet
  if (const fs::path folder = fs::path(path_).parent_path(); !folder.empty()) fs::create_directories(folder, error);
  if (error) throw InputError(write_error(path_, error.value()));
  file_ = open_beside(path_, temporary_);
  if (file_ < 0) throw InputError(write_error(path_, errno));
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (buffer_.size() + bytes.size() > buffer_bytes) flush();
  if (bytes.size() < buffer_bytes) {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  } else if (const int error = write_all(file_, bytes)) {
    throw InputError(write_error(path_, error));
  }
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void AtomicFile::flush() {
  const int error = write_all(file_, buffer_);
  if (error) throw InputError(write_error(path_, error));
  buffer_.clear();
}

void AtomicFile::commit(Durability durability) {
  flush();
  if (durability == Durability::power_cut && ::fsync(file_) != 0) throw InputError(write_error(path_, errno));
  // close() itself may report that a network disk is full.
  if (::close(std::exchange(file_, -1)) != 0) throw InputError(write_error(path_, errno));
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) throw InputError(write_error(path_, errno));
  temporary_.clear();
}

}  // namespace curlew
