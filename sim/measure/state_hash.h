// The witness of determinism: hashes of the state, compared between runs of the same binary (DESIGN, section 6).
// XXH3, 64 bits: https://github.com/Cyan4973/xxHash
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/core/fields.h"

namespace curlew {

// Hash of every bit of the kept fields, particle by particle in the order of their ids: where in memory a particle lies
// does not matter. Of a vector x, y and z count. Fields that are not in use (empty) are left out.
std::uint64_t state_hash(const Fields&);

// Hash of an array as it lies in memory, for passes.csv.
std::uint64_t array_hash(std::span<const std::byte>);

// Sixteen hexadecimal digits.
std::string hash_text(std::uint64_t);

// The places of the particles, by rising id; particles of the same id (which a sound state does not have) by place.
std::vector<std::uint32_t> order_by_id(std::span<const std::uint32_t> id);

}  // namespace curlew
