#include "sim/io/csv.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/core/error.h"
#include "sim/io/atomic_file.h"

namespace curlew {
namespace {

// RFC 4180, but for line breaks inside a cell: a line is a row here, or nothing could be cut at a line.
void append_cell(std::string& line, std::string_view cell) {
  if (cell.find_first_of("\r\n") != std::string_view::npos) throw std::logic_error("line break in a CSV cell");
  if (cell.find_first_of(",\"") == std::string_view::npos) {
    line += cell;
    return;
  }
  line += '"';
  for (const char c : cell) line.append(c == '"' ? 2 : 1, c);
  line += '"';
}

std::string line_of(std::span<const std::string> cells) {
  std::string line;
  for (const std::string& cell : cells) {
    append_cell(line, cell);
    line += ',';
  }
  if (!line.empty()) line.back() = '\n';
  return line;
}

InputError resume_error(const std::string& path, const std::string& what) {
  return InputError("cannot continue " + path + ": " + what + "; choose another --out");
}

// Names the first column in which two headers differ.
std::string header_difference(std::string_view found, std::string_view expected) {
  for (int column = 1;; ++column) {
    const std::string_view a = found.substr(0, found.find(',')), b = expected.substr(0, expected.find(','));
    if (a != b || found.size() == a.size() || expected.size() == b.size()) {
      if (a == b)
        return "it has " + std::string(found.size() < expected.size() ? "fewer" : "more") +
               " columns than this run writes";
      return "column " + std::to_string(column) + " of its header is \"" + std::string(a.substr(0, 60)) +
             "\", this run writes \"" + std::string(b) + "\"";
    }
    found.remove_prefix(a.size() + 1);
    expected.remove_prefix(b.size() + 1);
  }
}

std::int64_t step_of(const std::string& line, const std::string& path, std::uint64_t number) {
  const std::string_view cell = std::string_view(line).substr(0, line.find(','));
  std::int64_t step = 0;
  const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), step);
  if (result.ec != std::errc{} || result.ptr != cell.data() + cell.size()) {
    throw resume_error(path, "line " + std::to_string(number) + " begins with \"" + std::string(cell.substr(0, 60)) +
                                 "\" where a step number was expected");
  }
  return step;
}

// How many bytes of a file stay: whole lines, up to the first row of a later step. 0 where not even the header is
// whole.
std::uint64_t kept_bytes(const std::string& path, const std::string& header, std::int64_t last_step) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  std::uint64_t kept = 0;
  for (std::uint64_t number = 1; std::getline(in, line); ++number) {
    const bool whole = !in.eof();
    if (number == 1) {
      const std::string_view expected = std::string_view(header).substr(0, header.size() - 1);
      if (!whole && expected.substr(0, line.size()) == line) return 0;  // killed while writing the header
      if (line != expected) throw resume_error(path, header_difference(line, expected));
    }
    if (!whole || (number > 1 && step_of(line, path, number) > last_step)) break;
    kept += line.size() + 1;
  }
  if (in.bad()) throw resume_error(path, "it cannot be read");
  return kept;
}

}  // namespace

CsvWriter::CsvWriter(std::string path, std::vector<std::string> columns, std::optional<std::int64_t> resume_after)
    : path_(std::move(path)), columns_(columns.size()) {
  const std::string header = line_of(columns);
  if (header.empty()) throw std::logic_error("CSV without columns");
  std::error_code ignored;
  const bool resumes = resume_after && std::filesystem::exists(path_, ignored);
  const std::uint64_t kept = resumes ? kept_bytes(path_, header, *resume_after) : 0;

  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (resumes ? 0 : O_TRUNC), 0666);
  if (file_ < 0) throw InputError(write_error(path_, errno));
  try {
    // One call cuts at the end of a line: there is no moment at which the file is half cut.
    if (resumes && ::ftruncate(file_, static_cast<off_t>(kept)) != 0) throw InputError(write_error(path_, errno));
    size_ = kept;
    if (kept == 0) write_line(header);
  } catch (...) {
    ::close(file_);
    // A table without a header is of no use. (A device is not ours to remove.)
    if (size_ == 0 && std::filesystem::is_regular_file(path_, ignored)) std::filesystem::remove(path_, ignored);
    throw;
  }
}

CsvWriter::CsvWriter(CsvWriter&& other) noexcept
    : path_(std::move(other.path_)),
      columns_(other.columns_),
      size_(other.size_),
      last_row_(other.last_row_),
      file_(std::exchange(other.file_, -1)) {}

CsvWriter::~CsvWriter() {
  if (file_ >= 0) ::close(file_);
}

void CsvWriter::row(std::span<const std::string> cells) {
  if (cells.size() != columns_) throw std::logic_error("a CSV row needs as many cells as there are columns");
  const std::uint64_t begin = size_;
  write_line(line_of(cells));
  last_row_ = begin;
}

void CsvWriter::replace_last_row(std::span<const std::string> cells) {
  if (last_row_ > 0) {
    if (::ftruncate(file_, static_cast<off_t>(last_row_)) != 0) throw InputError(write_error(path_, errno));
    size_ = last_row_;
  }
  row(cells);
}

void CsvWriter::write_line(const std::string& line) {
  if (const int error = write_all(file_, std::as_bytes(std::span(line)))) {
    // Half a line may be in the file. Should cutting fail too, resume cuts it later; the first error is the one to
    // tell.
    [[maybe_unused]] const int cut = ::ftruncate(file_, static_cast<off_t>(size_));
    throw InputError(write_error(path_, error));
  }
  size_ += line.size();
}

void CsvWriter::close() {
  if (file_ >= 0 && ::close(std::exchange(file_, -1)) != 0) throw InputError(write_error(path_, errno));
}

}  // namespace curlew
