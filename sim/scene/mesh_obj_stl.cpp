// OBJ and STL files.
#include <cmath>
#include <cstring>
#include <string>

#include "sim/core/error.h"
#include "sim/scene/mesh_formats.h"
#include "sim/scene/text_reader.h"

namespace curlew {
namespace {

// The vertex that a corner such as 3, 3/1, 3//2, 3/1/2 or -1 names; negative numbers count from the last vertex so far.
std::uint32_t obj_corner(const TextReader& reader, std::string_view word, std::size_t vertices) {
  const long long number = reader.whole(word.substr(0, word.find('/')));
  const auto count = static_cast<long long>(vertices);
  const long long index = number < 0 ? count + number : number - 1;
  if (index < 0 || index >= count) {
    reader.fail(word, "the number of one of the " + std::to_string(count) + " vertices before it");
  }
  return static_cast<std::uint32_t>(index);
}

Vec3d float_vector(const char* bytes) {
  float values[3];
  std::memcpy(values, bytes, sizeof values);
  return {values[0], values[1], values[2]};
}

TriangleMesh read_binary_stl(std::string_view bytes, std::uint32_t count, const std::filesystem::path& file) {
  TriangleMesh mesh;
  for (std::uint32_t t = 0; t < count; ++t) {
    const char* corner = bytes.data() + 84 + std::size_t{50} * t + 12;  // behind the normal
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d p = float_vector(corner + 12 * k);
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        throw InputError(file.string() + ": triangle " + std::to_string(t) +
                         " has a coordinate that is not finite, expected finite numbers");
      }
      mesh.vertices.push_back(p);
    }
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

TriangleMesh read_ascii_stl(std::string_view text, const std::filesystem::path& file) {
  TriangleMesh mesh;
  TextReader reader(text, file);
  std::size_t corners = 0;
  bool ended = false;
  while (reader.next_line()) {
    const std::string_view first = reader.word();
    if (first == "vertex") {
      Vec3d p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = reader.number(reader.word());
      mesh.vertices.push_back(p);
      ++corners;
    } else if (first == "endloop") {
      if (corners != 3) reader.fail(first, "three vertices before it, not " + std::to_string(corners));
      const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.triangles.push_back({last - 3, last - 2, last - 1});
      corners = 0;
    } else if (first == "solid" || first == "endsolid") {
      ended = first == "endsolid";
    } else if (!first.empty() && first != "facet" && first != "outer" && first != "endfacet") {
      reader.fail(first, "facet, outer loop, vertex, endloop, endfacet or endsolid");
    }
  }
  if (!ended || corners != 0) throw InputError(file.string() + ": cut short, expected \"endsolid\" at the end");
  return mesh;
}

}  // namespace

TriangleMesh read_obj(std::string_view text, const std::filesystem::path& file) {
  TriangleMesh mesh;
  TextReader reader(text, file);
  while (reader.next_line()) {
    const std::string_view kind = reader.word();
    if (kind == "v") {
      Vec3d p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = reader.number(reader.word());
      mesh.vertices.push_back(p);
    } else if (kind == "f") {
      std::vector<std::uint32_t> corners;
      for (std::string_view word = reader.word(); !word.empty() && word[0] != '#'; word = reader.word()) {
        corners.push_back(obj_corner(reader, word, mesh.vertices.size()));
      }
      if (corners.size() < 3) reader.fail("", "three corners or more");
      for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  return mesh;
}

TriangleMesh read_stl(std::string_view text, const std::filesystem::path& file) {
  constexpr std::size_t header = 84, triangle = 50;
  std::uint32_t count = 0;
  if (text.size() >= header) std::memcpy(&count, text.data() + 80, sizeof count);
  if (text.size() >= header && text.size() == header + triangle * count) return read_binary_stl(text, count, file);
  if (text.starts_with("solid")) return read_ascii_stl(text, file);
  if (text.size() < header) {
    throw InputError(file.string() + ": cut short, expected the 84 bytes that begin a binary STL file");
  }
  throw InputError(file.string() + ": holds " + std::to_string(text.size()) + " bytes, expected " +
                   std::to_string(header + triangle * std::uint64_t{count}) + " for the " + std::to_string(count) +
                   " triangles that it promises");
}

}  // namespace curlew
