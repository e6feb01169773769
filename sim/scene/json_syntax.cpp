#include "sim/scene/json_syntax.h"

#include <algorithm>
#include <cctype>

#include "sim/scene/json.h"

namespace curlew {
namespace {

// A token, cut as loosely as a reader would: a string in quotes up to its end or its line's, a word, a single sign.
struct Token {
  std::size_t begin = 0, end = 0;
  bool whole = true;  // false for a string without its end
};

bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.' || c == '_';
}

// First byte from `at` on that is neither blank nor comment.
std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
      ++at;
    } else if (text.substr(at, 2) == "//") {
      at = std::min(text.find('\n', at), text.size());
    } else if (text.substr(at, 2) == "/*") {
      const std::size_t end = text.find("*/", at + 2);
      if (end == std::string_view::npos) break;
      at = end + 2;
    } else {
      break;
    }
  }
  return at;
}

Token token_at(std::string_view text, std::size_t begin) {
  std::size_t end = begin;
  if (text[begin] == '"') {
    for (end = begin + 1; end < text.size() && text[end] != '"' && text[end] != '\n'; ++end) {
      if (text[end] == '\\' && end + 1 < text.size()) ++end;
    }
    const bool whole = end < text.size() && text[end] == '"';
    return {begin, std::min(whole ? end + 1 : end, text.size()), whole};
  }
  while (end < text.size() && in_word(text[end])) ++end;
  return {begin, std::max(end, begin + std::max<std::size_t>(utf8_length(text, begin), 1))};
}

// The token that holds the byte, or the last before it; at the end an empty one. `before` is the first byte of the
// token in front of it, 0 where there is none.
Token find_token(std::string_view text, std::size_t byte, char& before) {
  Token token{text.size(), text.size()};
  before = '\0';
  for (std::size_t at = skip_blanks(text, 0); at < text.size() && at <= byte; at = skip_blanks(text, token.end)) {
    if (token.begin < text.size()) before = text[token.begin];
    token = token_at(text, at);
    if (token.end > byte || !token.whole) return token;
  }
  if (token.begin < text.size()) before = text[token.begin];
  return {text.size(), text.size()};
}

std::string found_text(std::string_view text, const Token& token) {
  if (token.begin == text.size()) return "the end of the file";
  const std::string_view word = text.substr(token.begin, token.end - token.begin);
  if (word == "/") return "a comment that does not end";
  if (word[0] != '"') return in_quotes(word);
  return token.whole ? "the text " + in_quotes(word.substr(1, word.size() - 2)) : "text without its closing quote";
}

std::string expected_text(std::string_view text, const Token& token, char before, const JsonProgress& progress) {
  const bool text_due = progress.in_object && !progress.after_key && (before == ',' || before == '{');
  const bool value_due = before == ':' || before == '[' || (before == ',' && !progress.in_object);
  const bool has_text = token.begin < text.size() && text[token.begin] == '"';
  if (has_text && !token.whole) return "text in double quotes on one line";
  if (progress.outermost) return progress.done ? "nothing after the scene" : "a scene, which begins with {";
  if (text_due) return std::string("a key in double quotes") + (before == '{' ? " or }" : "");
  if (has_text && value_due) return "text without control characters or unknown escapes";
  if (value_due) return "true, false, a finite number, text in double quotes, { or [";
  if (progress.after_key) return "a colon after the key " + in_quotes(progress.key);
  return progress.in_object ? "a comma or }" : "a comma or ]";
}

}  // namespace

std::string line_and_column(std::string_view text, std::size_t byte) {
  std::size_t line = 1, column = 1;
  for (std::size_t i = 0; i < byte && i < text.size(); ++i) {
    if (text[i] == '\n') {
      ++line;
      column = 1;
    } else if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) {
      ++column;
    }
  }
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned first = byte(i), second = byte(i + 1);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : (first & 0xF0U) == 0xE0U       ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0U) != 0x80U) return 0;
  }
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || beyond ? 0 : length;
}

std::string syntax_sentence(std::string_view text, std::size_t byte, const JsonProgress& progress) {
  char before = '\0';
  const Token token = find_token(text, byte, before);
  return line_and_column(text, token.begin) + ": found " + found_text(text, token) + ", expected " +
         expected_text(text, token, before, progress);
}

std::string overflow_sentence(std::string_view text, std::size_t byte) {
  char before = '\0';
  const Token token = find_token(text, byte, before);
  return line_and_column(text, token.begin) + ": found " + found_text(text, token) +
         ", expected a number of at most 1.8e308 in size";
}

}  // namespace curlew
