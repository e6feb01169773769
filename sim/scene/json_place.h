// A JSON value together with its place, so that whoever reads it can say where an error is. Every message names the
// file, the path of the key ("fluid[0].box.min"), what was found and what was expected.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/vec.h"
#include "sim/scene/json.h"

namespace curlew {

class JsonPlace {
 public:
  // Both must outlive the place and all places got from it.
  JsonPlace(const JsonNode& node, const std::filesystem::path& file) : node_(&node), file_(&file) {}

  const JsonNode& node() const { return *node_; }
  const std::filesystem::path& file() const { return *file_; }
  std::string path() const { return path_.empty() ? "the scene" : path_; }
  std::string place() const { return file_->string() + ": " + path(); }

  // Objects. `allow` throws unless this is an object and all its keys are in the list, naming the nearest.
  void allow(std::span<const std::string_view> keys) const;
  void allow(std::initializer_list<std::string_view> keys) const { allow(std::span(keys.begin(), keys.size())); }
  std::optional<JsonPlace> find(std::string_view key) const;
  JsonPlace at(std::string_view key) const;  // throws where the key is missing
  JsonPlace item(std::size_t index) const;   // of an object or an array

  // Values; each throws InputError where the type or the range is wrong.
  std::vector<JsonPlace> array(const std::string& expected) const;
  double number(double min, double max) const;
  double positive(double max) const;
  bool flag() const;
  const std::string& text() const;
  Vec3d vector(int count) const;                                      // components up to 1e6 in size
  std::size_t one_of(std::span<const std::string_view> names) const;  // index of the name

  // "FILE: PATH is FOUND, expected EXPECTED".
  [[noreturn]] void expected(const std::string& what) const;
  // "FILE: PATH SENTENCE".
  [[noreturn]] void fail(const std::string& sentence) const;

 private:
  JsonPlace(const JsonNode& node, const JsonPlace& parent, const std::string& path)
      : node_(&node), file_(parent.file_), path_(path) {}

  const JsonNode* node_;
  const std::filesystem::path* file_;
  std::string path_;
};

// "box, sphere or plane".
std::string joined_names(std::span<const std::string_view> names, std::string_view last_word);

}  // namespace curlew
