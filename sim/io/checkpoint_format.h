// What the writer and the reader of checkpoints share; the layout stands in checkpoint.h.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/core/error.h"
#include "sim/core/fields.h"

namespace curlew::checkpoint_format {

// Fields are written as they lie in memory.
static_assert(std::endian::native == std::endian::little);

inline constexpr std::string_view magic = "CURLEWCP";
inline constexpr std::uint32_t version = 1;
inline constexpr std::size_t prefix_bytes = 8 + 4 + 4 + 8;  // magic, version, header size, payload size
inline constexpr std::size_t checksum_bytes = 8;

// Calls f(row, array) for every field that is state, in the order of the table.
template <class FieldsLike, class F>
void for_each_kept_field(FieldsLike& fields, F&& f) {
  for_each_field(fields, [&](const FieldRow& row, auto& array) {
    if (is_saved(row.kind)) f(row, array);
  });
}

inline InputError damaged(const std::string& name, const std::string& what) {
  return InputError(name + " is damaged: " + what + "; take another checkpoint");
}

}  // namespace curlew::checkpoint_format
