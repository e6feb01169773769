// PLY files: a header that declares elements and their properties, then the elements as text or as bytes.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/scene/json.h"
#include "sim/scene/mesh_formats.h"
#include "sim/scene/text_reader.h"

namespace curlew {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64, none };
enum class Format { ascii, little, big };

Type type_of(std::string_view name) {
  struct Name {
    std::string_view old_name, new_name;
  };
  static constexpr Name names[] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
                                   {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  for (std::size_t k = 0; k < std::size(names); ++k) {
    if (name == names[k].old_name || name == names[k].new_name) return static_cast<Type>(k);
  }
  return Type::none;
}

struct Property {
  std::string name;
  Type type = Type::none;    // of the value, or of a list's items
  Type length = Type::none;  // of a list's length; none where the property is one value
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

Type checked_type(const TextReader& reader, std::string_view word) {
  const Type type = type_of(word);
  if (type == Type::none) reader.fail(word, "a PLY number type such as float or int");
  return type;
}

void read_property(TextReader& reader, Header& header) {
  if (header.elements.empty()) reader.fail("property", "an element before it");
  Property property;
  std::string_view word = reader.word();
  if (word == "list") {
    property.length = checked_type(reader, reader.word());
    word = reader.word();
  }
  property.type = checked_type(reader, word);
  property.name = reader.word();
  header.elements.back().properties.push_back(std::move(property));
}

Header read_header(TextReader& reader, const std::filesystem::path& file) {
  Header header;
  reader.next_line();
  if (const std::string_view magic = reader.word(); magic != "ply") reader.fail(magic, "ply");
  while (reader.next_line()) {
    const std::string_view kind = reader.word();
    if (kind == "end_header") {
      if (const std::string_view more = reader.word(); !more.empty()) reader.fail(more, "the end of the line");
      return header;
    }
    if (kind == "format") {
      const std::string_view format = reader.word();
      if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") {
        reader.fail(format, "ascii, binary_little_endian or binary_big_endian");
      }
      header.format = format == "ascii" ? Format::ascii : format[7] == 'l' ? Format::little : Format::big;
    } else if (kind == "element") {
      const std::string name(reader.word());
      const std::string_view word = reader.word();
      const long long count = reader.whole(word);
      if (count < 0) reader.fail(word, "a count");
      header.elements.push_back({name, static_cast<std::uint64_t>(count), {}});
    } else if (kind == "property") {
      read_property(reader, header);
    } else if (!kind.empty() && kind != "comment" && kind != "obj_info") {
      reader.fail(kind, "format, element, property, comment or end_header");
    }
  }
  throw InputError(file.string() + ": cut short, expected \"end_header\"");
}

template <class T>
double value_of(std::array<char, 8> bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value);
}

// The numbers behind the header, one after the other.
class Values {
 public:
  Values(std::string_view text, const TextReader& header_end, Format format, const std::filesystem::path& file)
      : text_(text), words_(header_end), format_(format), file_(file), at_(header_end.next_line_begin()) {}

  // `what` is named where the file ends before it.
  double next(Type type, const std::string& what) {
    if (format_ != Format::ascii) return next_binary(type, what);
    const std::string_view word = words_.word_anywhere();
    if (word.empty()) cut_short(what);
    return words_.number(word);
  }

 private:
  double next_binary(Type type, const std::string& what) {
    static constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    const std::size_t size = sizes[static_cast<std::size_t>(type)];
    if (text_.size() - at_ < size) cut_short(what);
    const bool swap = (format_ == Format::big) == (std::endian::native == std::endian::little);
    std::array<char, 8> bytes{};
    for (std::size_t k = 0; k < size; ++k) bytes[k] = text_[at_ + (swap ? size - 1 - k : k)];
    at_ += size;
    switch (type) {
      case Type::int8:
        return value_of<std::int8_t>(bytes);
      case Type::uint8:
        return value_of<std::uint8_t>(bytes);
      case Type::int16:
        return value_of<std::int16_t>(bytes);
      case Type::uint16:
        return value_of<std::uint16_t>(bytes);
      case Type::int32:
        return value_of<std::int32_t>(bytes);
      case Type::uint32:
        return value_of<std::uint32_t>(bytes);
      case Type::float32:
        return value_of<float>(bytes);
      default:
        return value_of<double>(bytes);
    }
  }

  [[noreturn]] void cut_short(const std::string& what) const {
    throw InputError(file_.string() + ": cut short in " + what + ", expected as many as the header promises");
  }

  std::string_view text_;
  TextReader words_;
  Format format_;
  const std::filesystem::path& file_;
  std::size_t at_;
};

// Takes the values of the elements as they come and keeps what makes a mesh.
class PlyMesh {
 public:
  explicit PlyMesh(const std::filesystem::path& file) : file_(file) {}

  void read(const Element& element, Values& values) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      const std::string what =
          in_quotes(element.name) + " " + std::to_string(i) + " of " + std::to_string(element.count);
      Vec3d place;
      for (const Property& property : element.properties) {
        if (property.length != Type::none) {
          read_list(element, property, values, what);
        } else {
          const double value = values.next(property.type, what);
          for (int axis = 0; axis < 3; ++axis) {
            if (property.name == std::string(1, "xyz"[axis])) place[axis] = value;
          }
        }
      }
      if (element.name != "vertex") continue;
      if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z)) {
        fail(what + " has a coordinate that is not finite, expected finite numbers");
      }
      mesh_.vertices.push_back(place);
    }
  }

  TriangleMesh finished() {
    for (const auto& corners : faces_) {
      for (const double corner : corners) {
        const auto count = static_cast<double>(mesh_.vertices.size());
        if (corner >= 0 && corner < count && corner == std::floor(corner)) continue;
        fail("a face names vertex " + plain_number(corner) + ", expected one of 0 to " + plain_number(count - 1));
      }
      for (std::size_t k = 2; k < corners.size(); ++k) {
        mesh_.triangles.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[k - 1]),
                                   static_cast<std::uint32_t>(corners[k])});
      }
    }
    return std::move(mesh_);
  }

 private:
  void read_list(const Element& element, const Property& property, Values& values, const std::string& what) {
    const double length = values.next(property.length, what);
    if (!(length >= 0) || length != std::floor(length)) {
      fail(what + " has a list of length " + plain_number(length) + ", expected a count");
    }
    std::vector<double> items;
    for (double k = 0; k < length; ++k) items.push_back(values.next(property.type, what));
    const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
    if (element.name == "face" && corners) faces_.push_back(std::move(items));
  }

  [[noreturn]] void fail(const std::string& sentence) const { throw InputError(file_.string() + ": " + sentence); }

  const std::filesystem::path& file_;
  TriangleMesh mesh_;
  std::vector<std::vector<double>> faces_;  // corners as they stand in the file
};

}  // namespace

TriangleMesh read_ply(std::string_view text, const std::filesystem::path& file) {
  TextReader reader(text, file);
  const Header header = read_header(reader, file);
  Values values(text, reader, header.format, file);
  PlyMesh mesh(file);
  for (const Element& element : header.elements) mesh.read(element, values);
  return mesh.finished();
}

}  // namespace curlew
