#include "sim/scene/json_place.h"

#include <algorithm>
#include <cmath>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/core/params.h"

namespace curlew {
namespace {

using Type = JsonNode::Type;

std::string described(const JsonNode& node) {
  switch (node.type) {
    case Type::null:
      return "null";
    case Type::flag:
      return node.flag ? "true" : "false";
    case Type::number:
      return plain_number(node.number);
    case Type::text:
      return in_quotes(node.text);
    case Type::object:
      return "an object";
    case Type::array:
      break;
  }
  return "an array of " + std::to_string(node.items.size()) + " values";
}

// A key as it stands in a path: what would spoil a message is shortened and quoted.
std::string key_text(std::string_view key) {
  const bool plain =
      key.size() <= 40 && std::all_of(key.begin(), key.end(), [](char c) { return c > ' ' && c < 0x7F; });
  return plain && !key.empty() ? std::string(key) : in_quotes(key);
}

}  // namespace

std::string joined_names(std::span<const std::string_view> names, std::string_view last_word) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) all += i + 1 == names.size() ? " " + std::string(last_word) + " " : ", ";
    all += names[i];
  }
  return all;
}

void JsonPlace::allow(std::span<const std::string_view> keys) const {
  if (node_->type != Type::object) expected("an object with the keys " + joined_names(keys, "and"));
  for (const std::string& key : node_->keys) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    const std::string near = nearest_name(key, keys);
    fail("has the unknown key " + in_quotes(key) +
         (near.empty() ? ", expected " + joined_names(keys, "or") : "; did you mean \"" + near + "\"?"));
  }
}

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
  for (std::size_t i = 0; i < node_->keys.size(); ++i) {
    if (node_->keys[i] == key) return item(i);
  }
  return std::nullopt;
}

JsonPlace JsonPlace::at(std::string_view key) const {
  if (auto member = find(key)) return *member;
  fail("has no key \"" + std::string(key) + "\", which it needs");
}

JsonPlace JsonPlace::item(std::size_t index) const {
  if (node_->type == Type::array) return {node_->items[index], *this, path_ + "[" + std::to_string(index) + "]"};
  return {node_->items[index], *this, (path_.empty() ? "" : path_ + ".") + key_text(node_->keys[index])};
}

std::vector<JsonPlace> JsonPlace::array(const std::string& what) const {
  if (node_->type != Type::array) expected(what);
  std::vector<JsonPlace> places;
  for (std::size_t i = 0; i < node_->items.size(); ++i) places.push_back(item(i));
  return places;
}

double JsonPlace::number(double min, double max) const {
  if (node_->type != Type::number || !(node_->number >= min && node_->number <= max)) {
    expected("a number from " + plain_number(min) + " to " + plain_number(max));
  }
  return node_->number;
}

double JsonPlace::positive(double max) const {
  if (node_->type != Type::number || !(node_->number > 0 && node_->number <= max)) {
    expected("a number above 0, up to " + plain_number(max));
  }
  return node_->number;
}

bool JsonPlace::flag() const {
  if (node_->type != Type::flag) expected("true or false");
  return node_->flag;
}

const std::string& JsonPlace::text() const {
  if (node_->type != Type::text) expected("text in double quotes");
  return node_->text;
}

Vec3d JsonPlace::vector(int count) const {
  constexpr double largest = 1e6;
  if (node_->type != Type::array || node_->items.size() != static_cast<std::size_t>(count)) {
    expected("an array of " + std::to_string(count) + (count == 1 ? " number" : " numbers"));
  }
  Vec3d value;
  for (int axis = 0; axis < count; ++axis) value[axis] = item(static_cast<std::size_t>(axis)).number(-largest, largest);
  return value;
}

std::size_t JsonPlace::one_of(std::span<const std::string_view> names) const {
  if (node_->type != Type::text) expected("one of " + joined_names(names, "or"));
  const auto hit = std::find(names.begin(), names.end(), node_->text);
  if (hit != names.end()) return static_cast<std::size_t>(hit - names.begin());
  const std::string near = nearest_name(node_->text, names);
  expected(near.empty() ? "one of " + joined_names(names, "or") : "a known name; did you mean \"" + near + "\"?");
}

void JsonPlace::expected(const std::string& what) const { fail("is " + described(*node_) + ", expected " + what); }

void JsonPlace::fail(const std::string& sentence) const { throw InputError(place() + " " + sentence); }

}  // namespace curlew
