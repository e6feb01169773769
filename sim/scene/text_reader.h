// Words and numbers of a text file, with the place of what is wrong.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace curlew {

class TextReader {
 public:
  // Both must outlive the reader.
  TextReader(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

  // Goes to the beginning of the next line, at first to that of the first; false at the end of the text.
  bool next_line();
  std::string_view line() const;  // the line, without its end
  // The next word of the line; empty at its end.
  std::string_view word();
  // The next word of the text, over line ends; empty at the end of the text.
  std::string_view word_anywhere();

  // The word as a finite number or a whole number; throws InputError.
  double number(std::string_view word) const;
  long long whole(std::string_view word) const;

  // "FILE: line L, column C: found WORD, expected EXPECTED", with the place of the last word.
  [[noreturn]] void fail(std::string_view word, const std::string& expected) const;

  std::size_t next_line_begin() const { return next_; }

 private:
  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t begin_ = 0, end_ = 0, next_ = 0;  // of the line, and the beginning of the next
  std::size_t at_ = 0, word_begin_ = 0;
};

}  // namespace curlew
