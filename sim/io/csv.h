// CSV tables that grow by whole flushed lines, so that they can be read, and resumed from, at any moment.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace curlew {

class CsvWriter {
 public:
  // Starts the file anew with its header, at once. With `resume_after` an existing file goes on instead: its header
  // must be the same, the rows whose first column (the step) is at most `resume_after` stay and the rest is cut; a
  // missing file is started. All members throw InputError naming the file and the system's reason.
  CsvWriter(std::string path, std::vector<std::string> columns, std::optional<std::int64_t> resume_after = {});
  ~CsvWriter();
  CsvWriter(CsvWriter&& other) noexcept;
  CsvWriter& operator=(CsvWriter&&) = delete;

  // One row of formatted cells, as many as there are columns; numbers as number_text (params.h) writes them. In the
  // file when this returns. Where the disk is full the file still ends in a whole line.
  void row(std::span<const std::string> cells);

  // The same, in place of the last row, or as the first where there is none yet.
  void replace_last_row(std::span<const std::string> cells);

  // Closes the file and reports what only closing can find out. The destructor closes silently.
  void close();

  const std::string& path() const { return path_; }

 private:
  void write_line(const std::string& line);

  std::string path_;
  std::size_t columns_ = 0;
  std::uint64_t size_ = 0;      // of the file, always at the end of a line
  std::uint64_t last_row_ = 0;  // where the last row begins; 0 before there is one
  int file_ = -1;
};

}  // namespace curlew
