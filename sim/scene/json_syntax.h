// Sentences for text that is not JSON: where it breaks, what stands there, and what should.
#pragma once

#include <string>
#include <string_view>

namespace curlew {

// How far the parser has come.
struct JsonProgress {
  bool done = false;       // the outermost value is complete
  bool in_object = false;  // else in an array, or before the outermost value where `outermost` is set
  bool outermost = true;
  bool after_key = false;  // a key was read, its value was not
  std::string key;
};

// "line 3, column 14: found ..., expected ..."; `byte` is the last byte that the parser read, text.size() for the end.
std::string syntax_sentence(std::string_view text, std::size_t byte, const JsonProgress&);

// The same for a number that is too large for double precision.
std::string overflow_sentence(std::string_view text, std::size_t byte);

// "line 3, column 14" of a byte; columns count characters.
std::string line_and_column(std::string_view text, std::size_t byte);

// Length of the UTF-8 character that begins at byte i, 0 where there is none (RFC 3629, section 4).
std::size_t utf8_length(std::string_view text, std::size_t i);

}  // namespace curlew
