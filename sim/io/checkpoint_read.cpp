// Reading checkpoints, which may come from anywhere: nothing in the file is believed before it is checked.
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"
#include "sim/io/checkpoint.h"
#include "sim/io/checkpoint_format.h"
#include "sim/io/checkpoint_payload.h"
#include "sim/measure/state_hash.h"

namespace curlew {
namespace {

namespace fs = std::filesystem;
using namespace checkpoint_format;

// A name from the file, fit to be shown.
std::string shown(std::string_view text) {
  std::string safe = "\"";
  for (const char c : text.substr(0, 40)) safe += c >= ' ' && c <= '~' ? c : '?';
  return safe + (text.size() > 40 ? "...\"" : "\"");
}

template <class T>
T load(std::span<const std::byte> bytes, std::size_t at = 0) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// Reads the header from front to back, never beyond its end.
class Cursor {
 public:
  Cursor(std::span<const std::byte> bytes, const std::string& name) : rest_(bytes), name_(name) {}

  template <class T>
  T number() {
    return load<T>(take(sizeof(T)));
  }
  std::string text() {
    const auto bytes = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) throw damaged(name_, "its header ends too early");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  std::span<const std::byte> rest_;
  const std::string& name_;
};

// What the first bytes say, checked against the size of the file; returns the bytes of the header.
std::size_t check_prefix(std::span<const std::byte> begin, std::uint64_t file_bytes, const std::string& name) {
  if (file_bytes == 0) throw InputError(name + " is empty; take another checkpoint");
  const std::string_view text(reinterpret_cast<const char*>(begin.data()), begin.size());
  if (text.substr(0, magic.size()) != magic.substr(0, text.size())) {
    throw InputError(name + " is not a Curlew checkpoint: it does not begin with " + std::string(magic));
  }
  const auto cut_off = [&](const std::string& of) {
    return InputError(name + " is cut off after " + std::to_string(file_bytes) + of +
                      " bytes; take another checkpoint");
  };
  if (begin.size() < prefix_bytes) throw cut_off("");
  const auto found_version = load<std::uint32_t>(begin, 8);
  if (found_version > version) {
    throw InputError(name + " has version " + std::to_string(found_version) +
                     " of the checkpoint format, this Curlew reads " + std::to_string(version) +
                     "; use the Curlew that wrote it, or a newer one");
  }
  if (found_version < 1) throw damaged(name, "it says version 0 of the checkpoint format");
  const std::size_t header_bytes = load<std::uint32_t>(begin, 12);
  const auto payload_bytes = load<std::uint64_t>(begin, 16);
  const std::uint64_t other_bytes = prefix_bytes + header_bytes + checksum_bytes;
  if (file_bytes < other_bytes || file_bytes - other_bytes < payload_bytes) {
    // A damaged size may be beyond all counting.
    const bool countable = payload_bytes < std::uint64_t{1} << 60;
    throw cut_off(countable ? " of " + std::to_string(other_bytes + payload_bytes) : "");
  }
  if (file_bytes - other_bytes > payload_bytes) {
    throw damaged(name, "it has " + std::to_string(file_bytes) + " bytes where its header says " +
                            std::to_string(other_bytes + payload_bytes));
  }
  return header_bytes;
}

void check_checksum(std::span<const std::byte> bytes, const std::string& name) {
  const auto covered = bytes.first(bytes.size() - checksum_bytes);
  const auto expected = load<std::uint64_t>(bytes, covered.size());
  const std::uint64_t found = XXH64(covered.data(), covered.size(), 0);
  if (found != expected) {
    throw damaged(name, "its checksum is " + hash_text(expected) + ", its contents give " + hash_text(found));
  }
}

std::uint64_t memory_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page)
                               : ~std::uint64_t{0};
}

void read_info(Cursor& header, CheckpointInfo& info, const std::string& name) {
  for (auto* text : {&info.scene_json, &info.scene_file, &info.program_version, &info.isa}) *text = header.text();
  info.seed = header.number<std::uint64_t>();
  info.step = header.number<std::int64_t>();
  info.time = header.number<double>();
  info.dt = header.number<double>();
  for (auto left = header.number<std::uint32_t>(); left > 0; --left) {
    std::string key = header.text();
    info.numbers.emplace_back(std::move(key), header.number<double>());
    if (!std::isfinite(info.numbers.back().second)) {
      throw damaged(name, "its number " + shown(info.numbers.back().first) + " is not finite");
    }
  }
  if (info.step < 0) throw damaged(name, "its step is " + std::to_string(info.step));
  if (!(info.time >= 0) || !std::isfinite(info.time)) throw damaged(name, "its time is " + std::to_string(info.time));
  if (!(info.dt >= 0) || !std::isfinite(info.dt)) throw damaged(name, "its time step is " + std::to_string(info.dt));
}

struct FieldInFile {
  std::string name, type;
  std::uint64_t values = 0;
};

std::vector<FieldInFile> read_field_list(Cursor& header, const CheckpointInfo& info, const std::string& name) {
  const auto particles = header.number<std::uint64_t>();
  constexpr std::uint64_t least_bytes = sizeof(Vec3) + sizeof(Vec3) + sizeof(std::uint32_t);  // position, velocity, id
  if (particles > memory_bytes() / least_bytes) {
    throw InputError(name + " says that it holds " + std::to_string(particles) +
                     " particles, which do not fit into the memory of this machine");
  }
  std::vector<FieldInFile> list;
  for (auto left = header.number<std::uint32_t>(); left > 0; --left) {
    FieldInFile field;
    field.name = header.text();
    field.type = header.text();
    field.values = header.number<std::uint64_t>();
    const auto row = std::find_if(std::begin(field_table), std::end(field_table),
                                  [&](const FieldRow& r) { return is_saved(r.kind) && r.name == field.name; });
    if (row == std::end(field_table)) {
      throw InputError(name + " holds the particle field " + shown(field.name) +
                       ", which this Curlew does not know; use the version that wrote it, " +
                       shown(info.program_version));
    }
    if (row->type != field.type) {
      throw InputError(name + " holds the particle field " + shown(field.name) + " as " + shown(field.type) +
                       ", this Curlew needs " + shown(row->type) + "; use the version that wrote it, " +
                       shown(info.program_version));
    }
    if (std::any_of(list.begin(), list.end(), [&](const FieldInFile& other) { return other.name == field.name; })) {
      throw damaged(name, "it holds the particle field " + shown(field.name) + " twice");
    }
    const bool may_be_unused = row->id != FieldId::position && row->id != FieldId::velocity && row->id != FieldId::id;
    if (field.values != particles && !(may_be_unused && field.values == 0)) {
      throw damaged(name, "the particle field " + shown(field.name) + " has " + std::to_string(field.values) +
                              " values for " + std::to_string(particles) + " particles");
    }
    list.push_back(std::move(field));
  }
  for (const FieldRow& row : field_table) {
    const bool present =
        std::any_of(list.begin(), list.end(), [&](const FieldInFile& f) { return f.name == row.name; });
    if (row.kind == FieldKind::kept && !present) {
      throw InputError(name + " lacks the particle field " + shown(row.name) +
                       ", which this Curlew needs; use the version that wrote it, " + shown(info.program_version));
    }
  }
  return list;
}

template <class T>
void read_values(PayloadReader& payload, std::uint64_t count, Array<T>& array) {
  constexpr std::size_t piece = (std::size_t{128} << 10) / sizeof(T);
  array.reserve(count);  // takes addresses, not yet memory
  while (array.size() < count) {
    const std::size_t before = array.size();
    array.resize(std::min<std::size_t>(count, before + piece));
    payload.read(std::as_writable_bytes(std::span(array).subspan(before)));
  }
}

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_finite(float v) { return std::isfinite(v); }
bool is_finite(std::uint32_t) { return true; }

void check_values(const Fields& fields, const std::string& name) {
  for_each_kept_field(fields, [&](const FieldRow& row, const auto& array) {
    const auto bad = std::find_if_not(array.begin(), array.end(), [](const auto& value) { return is_finite(value); });
    if (bad != array.end()) {
      const auto place = static_cast<std::size_t>(bad - array.begin());
      throw InputError(name + " holds a " + std::string(row.name) + " that is not finite (particle " +
                       std::to_string(fields.id[place]) + "); take a checkpoint from before the simulation diverged");
    }
  });
  const std::vector<std::uint32_t> order = order_by_id(fields.id);
  const auto twice = std::adjacent_find(order.begin(), order.end(),
                                        [&](std::uint32_t a, std::uint32_t b) { return fields.id[a] == fields.id[b]; });
  if (twice != order.end()) throw damaged(name, "particle " + std::to_string(fields.id[*twice]) + " occurs twice");
}

Checkpoint read_checked(std::span<const std::byte> bytes, const std::string& name) {
  const std::size_t header_bytes = check_prefix(bytes.first(std::min(bytes.size(), prefix_bytes)), bytes.size(), name);
  check_checksum(bytes, name);

  Checkpoint checkpoint;
  Cursor header(bytes.subspan(prefix_bytes, header_bytes), name);
  read_info(header, checkpoint, name);
  const std::vector<FieldInFile> list = read_field_list(header, checkpoint, name);
  if (!header.at_end()) throw damaged(name, "its header is longer than its contents");

  std::uint64_t raw_bytes = 0;
  for_each_kept_field(checkpoint.fields, [&]<class T>(const FieldRow& row, const Array<T>&) {
    for (const FieldInFile& field : list) raw_bytes += field.name == row.name ? field.values * sizeof(T) : 0;
  });
  const auto frame =
      bytes.subspan(prefix_bytes + header_bytes).first(bytes.size() - prefix_bytes - header_bytes - checksum_bytes);
  PayloadReader payload(frame, raw_bytes, name);
  for (const FieldInFile& field : list) {
    for_each_kept_field(checkpoint.fields, [&](const FieldRow& row, auto& array) {
      if (field.name == row.name) read_values(payload, field.values, array);
    });
  }
  if (!payload.ends()) throw damaged(name, "its data are longer than its fields");
  check_values(checkpoint.fields, name);
  return checkpoint;
}

// Checkpoints of a folder, by name, so that the last is the newest.
std::vector<std::string> checkpoints_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".curlew") names.push_back(entry->path().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void check_is_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    auto inside = checkpoints_in(path);
    if (inside.empty()) inside = checkpoints_in(fs::path(path) / "checkpoints");
    throw InputError(
        path + " is a folder, not a checkpoint" +
        (inside.empty() ? "; give a file that --checkpoint-every wrote" : "; did you mean " + inside.back() + "?"));
  }
  if (!fs::exists(status)) {
    const std::string near = nearest_name(path, checkpoints_in(fs::path(path).parent_path()));
    throw InputError("cannot read " + path + ": " + (error ? error.message() : "No such file or directory") +
                     (near.empty() ? "" : "; did you mean " + near + "?"));
  }
  if (!fs::is_regular_file(status))
    throw InputError(path + " is not a regular file; give a file that --checkpoint-every wrote");
}

}  // namespace

Checkpoint read_checkpoint(std::span<const std::byte> bytes, const std::string& name) {
  try {
    return read_checked(bytes, name);
  } catch (const std::bad_alloc&) {
    throw InputError(name + " needs more memory than there is; close other programs or use a larger machine");
  }
}

Checkpoint read_checkpoint(const std::string& path) {
  check_is_file(path);
  std::ifstream in(path, std::ios::binary);
  const auto fail = [&] { return InputError("cannot read " + path + ": " + std::generic_category().message(errno)); };
  if (!in) throw fail();
  std::error_code error;
  const std::uint64_t size = fs::file_size(path, error);
  if (error) throw InputError("cannot read " + path + ": " + error.message());

  // The first bytes come first: a film given by mistake is not read as a whole.
  const auto read = [&](std::span<std::byte> bytes) {
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!in) throw fail();
  };
  std::vector<std::byte> bytes(std::min<std::uint64_t>(size, prefix_bytes));
  read(bytes);
  check_prefix(bytes, size, path);
  if (size > memory_bytes()) throw InputError(path + " does not fit into the memory of this machine");
  try {
    const std::size_t begin = bytes.size();
    bytes.resize(size);
    read(std::span(bytes).subspan(begin));
  } catch (const std::bad_alloc&) {
    throw InputError(path + " needs more memory than there is; close other programs or use a larger machine");
  }
  return read_checkpoint(bytes, path);
}

}  // namespace curlew
