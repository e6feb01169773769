// JSON as a tree that keeps what strict checking needs: the order of the keys, and nothing twice. Reading goes through
// nlohmann-json's event parser, which lives in json.cpp alone.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace curlew {

struct JsonNode {
  enum class Type { null, flag, number, text, array, object };

  Type type = Type::null;
  bool flag = false;
  double number = 0;
  std::string text;
  std::vector<std::string> keys;  // of an object, one for each item
  std::vector<JsonNode> items;

  static JsonNode of(bool value);
  static JsonNode of(double value);
  static JsonNode of(std::string value);
  static JsonNode of(const char* value) { return of(std::string(value)); }
  static JsonNode object();
  static JsonNode array();

  // Appends to an object or an array; returns *this, so that calls chain.
  JsonNode& add(std::string key, JsonNode value);
  JsonNode& add(JsonNode value);
};

// Parses JSON text in UTF-8 with // and /* */ comments. Throws InputError, naming the file and the line and column, or
// the path of a key that stands twice. Nesting deeper than 32 is refused.
JsonNode parse_json(const std::string& text, const std::filesystem::path& file);

// Pretty JSON that parse_json reads back to the same tree; short arrays and objects sit on one line.
std::string json_text(const JsonNode&);

// A number as people write it, 100000 and 1e-6, not 1e+05 and 1e-06: for messages.
std::string plain_number(double);

// Text in double quotes, shortened to 40 characters, unprintable bytes replaced: for messages.
std::string in_quotes(std::string_view text);

}  // namespace curlew
