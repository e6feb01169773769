// Files that appear whole or not at all: written beside their place under another name, then renamed. Whoever reads a
// run folder while the program runs, or after it was killed, never meets half a file.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace curlew {

class AtomicFile {
 public:
  // A checkpoint should outlive a power cut; for the frames of a film waiting for the disk costs more than it saves.
  enum class Durability { process, power_cut };

  // Opens `path`.unfinishedN; missing folders are made. All members throw InputError naming the file and the system's
  // reason.
  explicit AtomicFile(std::string path);
  // Removes what was written, unless commit() came first.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  // Flushes, closes and renames. Nothing may be written after it.
  void commit(Durability durability = Durability::process);

 private:
  void flush();

  std::string path_, temporary_;
  std::vector<std::byte> buffer_;
  int file_ = -1;
};

// What AtomicFile adds to a name while it writes.
inline constexpr std::string_view unfinished_suffix = ".unfinished";

// Writes everything to an open file descriptor; returns 0, or the errno of the first failure, after which some of the
// bytes may be in the file.
int write_all(int file, std::span<const std::byte> bytes);

// "cannot write out/stats.csv: No space left on device; free some space or choose another folder".
std::string write_error(const std::string& path, int error);

}  // namespace curlew
