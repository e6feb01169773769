#include "sim/scene/text_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/core/error.h"
#include "sim/scene/json.h"
#include "sim/scene/json_syntax.h"

namespace curlew {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

bool TextReader::next_line() {
  if (next_ >= text_.size()) return false;
  begin_ = at_ = word_begin_ = next_;
  end_ = std::min(text_.find('\n', begin_), text_.size());
  next_ = std::min(end_ + 1, text_.size());
  return true;
}

std::string_view TextReader::line() const { return text_.substr(begin_, end_ - begin_); }

std::string_view TextReader::word() {
  while (at_ < end_ && is_blank(text_[at_])) ++at_;
  word_begin_ = at_;
  while (at_ < end_ && !is_blank(text_[at_])) ++at_;
  return text_.substr(word_begin_, at_ - word_begin_);
}

std::string_view TextReader::word_anywhere() {
  while (true) {
    const std::string_view found = word();
    if (!found.empty() || !next_line()) return found;
  }
}

double TextReader::number(std::string_view word) const {
  const std::string_view digits = word.substr(!word.empty() && word[0] == '+' ? 1 : 0);
  double value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
    fail(word, "a finite number");
  return value;
}

long long TextReader::whole(std::string_view word) const {
  long long value = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc() || end != word.data() + word.size()) fail(word, "a whole number");
  return value;
}

void TextReader::fail(std::string_view word, const std::string& expected) const {
  const bool at_end = word.empty() && next_ >= text_.size();
  const std::string found = at_end ? "the end of the file" : word.empty() ? "the end of the line" : in_quotes(word);
  throw InputError(file_.string() + ": " + line_and_column(text_, word_begin_) + ": found " + found + ", expected " +
                   expected);
}

}  // namespace curlew
