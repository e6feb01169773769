#include "sim/io/particle_read.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

#include "sim/core/error.h"
#include "sim/scene/file_text.h"
#include "sim/scene/json.h"

namespace curlew {
namespace {

// Where a file has a number for each particle: the first, and how far apart they are.
struct Column {
  std::size_t first = 0, stride = 0;
  std::size_t words = 1;
};

// A file taken from front to back.
class Bytes {
 public:
  Bytes(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

  [[noreturn]] void fail(const std::string& sentence) const { throw InputError(file_.string() + ": " + sentence); }

  std::string_view take(std::size_t count, const std::string& what) {
    if (text_.size() - at_ < count) fail("cut short in " + what);
    at_ += count;
    return text_.substr(at_ - count, count);
  }
  std::string_view line(const std::string& what) {
    const auto end = text_.find('\n', at_);
    if (end == std::string_view::npos) fail("cut short in " + what);
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = end + 1;
    return found;
  }
  // The next line must be this one, or begin with it, and then the rest comes back.
  std::string_view line_after(std::string_view beginning) {
    const std::string_view found = line("its header");
    if (!found.starts_with(beginning)) {
      fail("found " + in_quotes(std::string(found.substr(0, 40))) + ", expected " + in_quotes(std::string(beginning)) +
           " as this program writes it");
    }
    return found.substr(beginning.size());
  }
  template <class T>
  T number(std::endian order, const std::string& what) {
    char raw[sizeof(T)];
    const std::string_view bytes = take(sizeof(T), what);
    for (std::size_t k = 0; k < sizeof(T); ++k) raw[k] = bytes[order == std::endian::native ? k : sizeof(T) - 1 - k];
    T value;
    std::memcpy(&value, raw, sizeof value);
    return value;
  }
  std::size_t count(std::string_view text) const {
    std::size_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    // A particle takes more than a byte, so no file holds more particles than bytes.
    if (status != std::errc() || value > text_.size()) {
      fail("found " + in_quotes(std::string(text.substr(0, 40))) + ", expected a number of particles that it can hold");
    }
    return value;
  }
  std::size_t at() const { return at_; }

  std::uint32_t word(std::size_t at, std::endian order) const {
    if (at + 4 > text_.size()) fail("cut short in its particles");
    std::uint32_t value;
    std::memcpy(&value, text_.data() + at, sizeof value);
    return order == std::endian::native ? value : __builtin_bswap32(value);
  }

 private:
  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
};

using Columns = std::map<std::string, Column, std::less<>>;

ParticleSet collect(const Bytes& bytes, const Columns& columns, std::size_t particles, std::endian order) {
  ParticleSet set;
  const auto column = [&](const char* name, std::size_t words) {
    const auto found = columns.find(name);
    if (found == columns.end() || found->second.words != words)
      bytes.fail("has no " + std::string(name) + ", expected particles as this program writes them");
    return found->second;
  };
  const auto real = [&](const Column& c, std::size_t i, std::size_t k) {
    return std::bit_cast<float>(bytes.word(c.first + i * c.stride + 4 * k, order));
  };
  const Column position = column("position", 3), velocity = column("velocity", 3), density = column("density", 1),
               id = column("id", 1);
  set.id.resize(particles);
  set.position.resize(particles);
  set.velocity.resize(particles);
  set.density.resize(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    set.position[i] = {real(position, i, 0), real(position, i, 1), real(position, i, 2)};
    set.velocity[i] = {real(velocity, i, 0), real(velocity, i, 1), real(velocity, i, 2)};
    set.density[i] = real(density, i, 0);
    set.id[i] = bytes.word(id.first + i * id.stride, order);
    const Vec3 p = set.position[i];
    if (!std::isfinite(p.x + p.y + p.z))
      bytes.fail("particle " + std::to_string(i) + " has a position that is not finite");
  }
  return set;
}

// "..., time 0.25 s, step 120": what the writers put into their comment.
void read_origin(std::string_view comment, ParticleSet& set) {
  const auto after = [&](std::string_view word) {
    const auto at = comment.find(word);
    return at == std::string_view::npos ? std::string_view{} : comment.substr(at + word.size());
  };
  double time = 0;
  std::int64_t step = 0;
  const auto read = [](std::string_view text, auto& value) {
    return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
  };
  if (read(after("time "), time)) set.time = time;
  if (read(after("step "), step)) set.step = step;
}

ParticleSet read_ply_particles(Bytes& bytes) {
  bytes.line_after("ply");
  bytes.line_after("format binary_little_endian 1.0");
  const std::string_view comment = bytes.line_after("comment Curlew");
  const std::size_t particles = bytes.count(bytes.line_after("element vertex "));
  Columns columns;
  std::size_t stride = 0;
  for (std::string_view line = bytes.line("its header"); line != "end_header"; line = bytes.line("its header")) {
    if (!line.starts_with("property ")) bytes.fail("found " + in_quotes(std::string(line)) + ", expected a property");
    const std::string name(line.substr(line.rfind(' ') + 1));
    if (name == "x") columns["position"] = {stride, 0, 3};
    if (name == "vx") columns["velocity"] = {stride, 0, 3};
    if (name == "density" || name == "id") columns[name] = {stride, 0, 1};
    stride += 4;
  }
  const std::size_t first = bytes.at();
  bytes.take(particles * stride, "its particles");
  for (auto& [name, column] : columns) column = {first + column.first, stride, column.words};
  ParticleSet set = collect(bytes, columns, particles, std::endian::little);
  read_origin(comment, set);
  return set;
}

ParticleSet read_vtk_particles(Bytes& bytes) {
  bytes.line_after("# vtk DataFile Version 3.0");
  const std::string_view comment = bytes.line_after("Curlew");
  bytes.line_after("BINARY");
  bytes.line_after("DATASET POLYDATA");
  bytes.line_after("FIELD FieldData 2");
  for (const char* name : {"TIME 1 1 double", "CYCLE 1 1 double"}) {
    bytes.line_after(name);
    bytes.take(9, "its header");
  }
  const std::size_t particles = bytes.count(bytes.line_after("POINTS "));
  Columns columns;
  const auto block = [&](const std::string& name, std::size_t words) {
    columns[name] = {bytes.at(), 4 * words, words};
    bytes.take(4 * words * particles, "its " + name);
  };
  block("position", 3);
  bytes.take(1, "its header");
  bytes.line_after("VERTICES ");
  bytes.take(8 * particles + 1, "its vertices");
  bytes.line_after("POINT_DATA ");
  while (columns.size() < 4) {
    const std::string_view line = bytes.line("its fields");
    const bool vector = line.starts_with("VECTORS ");
    if (!vector && !line.starts_with("SCALARS "))
      bytes.fail("found " + in_quotes(std::string(line.substr(0, 40))) + ", expected SCALARS or VECTORS");
    const std::string_view rest = line.substr(8);
    const std::string name(rest.substr(0, rest.find(' ')));
    if (!vector) bytes.line_after("LOOKUP_TABLE default");
    block(name, vector ? 3 : 1);
    bytes.take(1, "its fields");
  }
  ParticleSet set = collect(bytes, columns, particles, std::endian::big);
  read_origin(comment, set);
  return set;
}

ParticleSet read_bgeo_particles(Bytes& bytes) {
  constexpr auto big = std::endian::big;
  if (bytes.take(5, "its header") != "BgeoV" || bytes.number<std::int32_t>(big, "its header") != 5)
    bytes.fail("does not begin as a bgeo file of version 5");
  std::array<std::int32_t, 8> numbers{};
  for (std::int32_t& n : numbers) n = bytes.number<std::int32_t>(big, "its header");
  const std::size_t particles = bytes.count(std::to_string(numbers[0]));
  Columns columns{{"position", {0, 0, 3}}};
  std::size_t stride = 16;
  for (std::int32_t k = 0; k < numbers[4]; ++k) {
    const auto length = static_cast<std::uint16_t>(bytes.number<std::int16_t>(big, "its header"));
    std::string name(bytes.take(length, "its header"));
    const auto words = static_cast<std::uint16_t>(bytes.number<std::int16_t>(big, "its header"));
    bytes.take(4 + std::size_t{4} * words, "its header");
    columns[name == "v" ? "velocity" : name] = {stride, 0, words};
    stride += std::size_t{4} * words;
  }
  const std::size_t first = bytes.at();
  bytes.take(particles * stride, "its particles");
  for (auto& [name, column] : columns) column = {first + column.first, stride, column.words};
  return collect(bytes, columns, particles, big);
}

}  // namespace

ParticleSet read_particles(const std::filesystem::path& file) {
  const std::string text = read_file(file, std::uintmax_t{1} << 36, "particles");
  Bytes bytes(text, file);
  const std::string kind = file.extension().string();
  if (kind == ".ply") return read_ply_particles(bytes);
  if (kind == ".vtk") return read_vtk_particles(bytes);
  if (kind == ".bgeo") return read_bgeo_particles(bytes);
  throw InputError(file.string() + ": found a file of another kind, expected .vtk, .ply or .bgeo");
}

}  // namespace curlew
