#include "sim/scene/json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/core/error.h"
#include "sim/core/params.h"
#include "sim/scene/json_syntax.h"

namespace curlew {
namespace {

constexpr std::size_t deepest = 32;

void require_utf8(const std::string& text, const std::filesystem::path& file) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) {
      constexpr char digits[] = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(text[i]);
      throw InputError(file.string() + ": " + line_and_column(text, i) + ": found the byte 0x" + digits[byte >> 4U] +
                       digits[byte & 15U] + ", expected text in UTF-8");
    }
    i += length;
  }
}

using Sax = nlohmann::json_sax<nlohmann::json>;

class TreeBuilder : public Sax {
 public:
  TreeBuilder(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

  JsonNode root;

  bool null() override { return put({}); }
  bool boolean(bool value) override { return put(JsonNode::of(value)); }
  bool number_integer(number_integer_t value) override { return put(JsonNode::of(static_cast<double>(value))); }
  bool number_unsigned(number_unsigned_t value) override { return put(JsonNode::of(static_cast<double>(value))); }
  bool number_float(number_float_t value, const string_t&) override { return put(JsonNode::of(value)); }
  bool string(string_t& value) override { return put(JsonNode::of(std::move(value))); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonNode::object()); }
  bool start_array(std::size_t) override { return open(JsonNode::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    if (!level.seen.insert(name).second) {
      throw InputError(file_.string() + ": " + path() + " has the key " + in_quotes(name) + " twice, expected it once");
    }
    level.key = name;
    level.after_key = true;
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    // The position counts bytes read, one more at the end of the text.
    const std::size_t byte = std::min(position == 0 ? 0 : position - 1, text_.size());
    constexpr int number_overflow = 406;
    const bool overflow = error.id == number_overflow;
    throw InputError(file_.string() + ": " +
                     (overflow ? overflow_sentence(text_, byte) : syntax_sentence(text_, byte, progress())));
  }

 private:
  struct Level {
    JsonNode node;
    std::string key;
    std::set<std::string> seen;
    bool after_key = false;
  };

  bool put(JsonNode value) {
    if (levels_.empty()) {
      root = std::move(value);
      done_ = true;
      return true;
    }
    Level& level = levels_.back();
    if (level.node.type == JsonNode::Type::object) {
      level.node.add(level.key, std::move(value));
    } else {
      level.node.add(std::move(value));
    }
    level.after_key = false;
    return true;
  }

  bool open(JsonNode node) {
    if (levels_.size() == deepest) {
      throw InputError(file_.string() + ": found values nested deeper than " + std::to_string(deepest) +
                       ", expected a scene, which needs 5");
    }
    levels_.push_back({std::move(node), {}, {}, false});
    return true;
  }

  bool close() {
    JsonNode node = std::move(levels_.back().node);
    levels_.pop_back();
    return put(std::move(node));
  }

  std::string path() const {
    std::string text;
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
      const Level& level = levels_[i];
      if (level.node.type == JsonNode::Type::array) {
        text += "[" + std::to_string(level.node.items.size()) + "]";
      } else {
        text += (text.empty() ? "" : ".") + level.key;
      }
    }
    return text.empty() ? "the scene" : text;
  }

  JsonProgress progress() const {
    if (levels_.empty()) return {.done = done_, .key = {}};
    const Level& level = levels_.back();
    return {.in_object = level.node.type == JsonNode::Type::object,
            .outermost = false,
            .after_key = level.after_key,
            .key = level.key};
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  std::vector<Level> levels_;
  bool done_ = false;
};

std::string scalar_text(const JsonNode& node) {
  switch (node.type) {
    case JsonNode::Type::flag:
      return node.flag ? "true" : "false";
    case JsonNode::Type::number:
      return number_text(node.number);
    case JsonNode::Type::text:
      return nlohmann::json(node.text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    default:
      return "null";
  }
}

std::string node_text(const JsonNode& node, std::size_t indent, bool spread) {
  const bool object = node.type == JsonNode::Type::object;
  if (!object && node.type != JsonNode::Type::array) return scalar_text(node);
  constexpr std::size_t widest = 100;
  const std::string gap = spread ? "\n" + std::string(indent + 2, ' ') : "";
  std::string text(1, object ? '{' : '[');
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    text += (i == 0 ? "" : spread ? "," : ", ") + gap;
    if (object) text += scalar_text(JsonNode::of(node.keys[i])) + ": ";
    std::string item = node_text(node.items[i], indent + 2, false);
    if (spread && item.size() + indent > widest) item = node_text(node.items[i], indent + 2, true);
    text += item;
  }
  if (spread && !node.items.empty()) text += "\n" + std::string(indent, ' ');
  return text + (object ? '}' : ']');
}

}  // namespace

JsonNode JsonNode::of(bool value) {
  JsonNode node;
  node.type = Type::flag;
  node.flag = value;
  return node;
}

JsonNode JsonNode::of(double value) {
  JsonNode node;
  node.type = Type::number;
  node.number = value;
  return node;
}

JsonNode JsonNode::of(std::string value) {
  JsonNode node;
  node.type = Type::text;
  node.text = std::move(value);
  return node;
}

JsonNode JsonNode::object() {
  JsonNode node;
  node.type = Type::object;
  return node;
}

JsonNode JsonNode::array() {
  JsonNode node;
  node.type = Type::array;
  return node;
}

JsonNode& JsonNode::add(std::string key, JsonNode value) {
  keys.push_back(std::move(key));
  items.push_back(std::move(value));
  return *this;
}

JsonNode& JsonNode::add(JsonNode value) {
  items.push_back(std::move(value));
  return *this;
}

JsonNode parse_json(const std::string& text, const std::filesystem::path& file) {
  require_utf8(text, file);
  TreeBuilder builder(text, file);
  constexpr bool strict = true, ignore_comments = true;
  if (!nlohmann::json::sax_parse(text, &builder, nlohmann::json::input_format_t::json, strict, ignore_comments)) {
    throw InputError(file.string() + ": found text that is not JSON, expected a scene, which begins with {");
  }
  return std::move(builder.root);
}

std::string json_text(const JsonNode& node) { return node_text(node, 0, true) + "\n"; }

std::string plain_number(double value) {
  const double size = std::abs(value);
  if (value == 0 || (size >= 1e-4 && size < 1e15)) {
    char buffer[64];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed).ptr};
  }
  std::string text = number_text(value);  // 1e-06 and 1e+300: the sign of plus and leading zeros go
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    const std::size_t digits = text[e + 1] == '-' ? e + 2 : e + 1;
    text.erase(digits, text.find_first_not_of("+0", digits) - digits);
  }
  return text;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown;
  for (std::size_t i = 0; i < text.size() && shown.size() < longest;) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, i), 1);
    const bool printable = utf8_length(text, i) > 0 && static_cast<unsigned char>(text[i]) >= ' ' && text[i] != 0x7F;
    shown += printable ? text.substr(i, length) : "?";
    i += length;
    if (shown.size() >= longest && i < text.size()) shown += "...";
  }
  return "\"" + shown + "\"";
}

}  // namespace curlew
