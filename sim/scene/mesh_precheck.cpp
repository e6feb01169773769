#include "sim/scene/mesh_precheck.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

#include "sim/core/error.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json.h"

namespace curlew {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{512} << 20U;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& sentence) {
  throw InputError(file.string() + ": " + sentence);
}

void precheck_stl(const std::filesystem::path& file, const std::string& text) {
  constexpr std::size_t header = 84, triangle = 50;
  std::uint32_t count = 0;
  if (text.size() >= header) std::memcpy(&count, text.data() + 80, sizeof count);
  if (text.size() >= header && text.size() == header + triangle * count) return;
  if (text.starts_with("solid")) {
    if (text.find("endsolid") == std::string::npos) fail(file, "cut short, expected \"endsolid\" at the end");
    return;
  }
  if (text.size() < header) fail(file, "cut short, expected the 84 bytes that begin a binary STL file");
  fail(file, "holds " + std::to_string(text.size()) + " bytes, expected " +
                 std::to_string(header + triangle * std::uint64_t{count}) + " for the " + std::to_string(count) +
                 " triangles that it promises");
}

std::size_t ply_type_size(const std::string& type) {
  for (const char* name : {"char", "uchar", "int8", "uint8"}) {
    if (type == name) return 1;
  }
  for (const char* name : {"short", "ushort", "int16", "uint16"}) {
    if (type == name) return 2;
  }
  for (const char* name : {"int", "uint", "int32", "uint32", "float", "float32"}) {
    if (type == name) return 4;
  }
  return type == "double" || type == "float64" ? 8 : 0;
}

// Fewest bytes that the elements of a PLY header need: in binary the size of each property (an empty list is its
// length alone), as text a digit and a blank for each.
std::uintmax_t least_ply_bytes(const std::filesystem::path& file, const std::string& header) {
  std::istringstream lines(header);
  bool binary = false;
  double need = 0, count = 0;  // double: counts in a hostile header overflow integers
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "format") binary = second != "ascii";
    if (first == "element") {
      const bool digits = !third.empty() && third.find_first_not_of("0123456789") == std::string::npos;
      if (!digits || third.size() > 18) {
        fail(file, "promises " + in_quotes(third) + " elements " + in_quotes(second) + ", expected a count");
      }
      count = std::stod(third);
    }
    if (first != "property") continue;
    const std::size_t size = ply_type_size(second == "list" ? third : second);
    if (size == 0) fail(file, "has a property of the type " + in_quotes(second) + ", expected a PLY number type or list");
    need += count * (binary ? static_cast<double>(size) : 2);
  }
  return need < 1e18 ? static_cast<std::uintmax_t>(need) : UINTMAX_MAX;
}

void precheck_ply(const std::filesystem::path& file, const std::string& text) {
  if (!text.starts_with("ply")) fail(file, "begins with " + in_quotes(text.substr(0, 8)) + ", expected \"ply\"");
  const std::size_t end = text.find("end_header");
  if (end == std::string::npos) fail(file, "cut short, expected \"end_header\"");
  const std::size_t body = text.size() - std::min(text.size(), text.find('\n', end)) + 1;
  const std::uintmax_t need = least_ply_bytes(file, text.substr(0, end));
  if (need > body) {
    fail(file, "cut short: " + std::to_string(body) + " bytes follow the header, expected at least " +
                   std::to_string(need) + " for the elements that it promises");
  }
}

}  // namespace

void precheck_mesh_file(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  if (kind != ".obj" && kind != ".ply" && kind != ".stl") {
    fail(file, "has the extension " + in_quotes(kind) + ", expected .obj, .ply or .stl");
  }
  const std::string text = read_file(file, largest_file, "a triangle mesh");
  if (kind == ".stl") precheck_stl(file, text);
  if (kind == ".ply") precheck_ply(file, text);
}

}  // namespace curlew
