#include "sim/measure/state_hash.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>

namespace curlew {
namespace {

struct HashDeleter {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

// The bytes of a value that count: of vectors not the spare number, but where a model keeps something in it.
template <class T>
std::size_t hashed_bytes(const FieldRow& row) {
  return std::is_same_v<T, Vec3> && row.kind != FieldKind::model ? 3 * sizeof(float) : sizeof(T);
}

template <class T>
void hash_in_order(XXH3_state_t* state, std::span<const T> values, std::span<const std::uint32_t> order,
                   std::size_t bytes) {
  constexpr std::size_t block = 1024;
  std::array<std::byte, block * sizeof(T)> gathered;
  for (std::size_t begin = 0; begin < order.size(); begin += block) {
    const auto places = order.subspan(begin, std::min(block, order.size() - begin));
    std::byte* out = gathered.data();
    for (const std::uint32_t place : places) {
      std::memcpy(out, &values[place], bytes);
      out += bytes;
    }
    XXH3_64bits_update(state, gathered.data(), places.size() * bytes);
  }
}

}  // namespace

std::vector<std::uint32_t> order_by_id(std::span<const std::uint32_t> id) {
  std::vector<std::uint32_t> order(id.size());
  if (id.empty()) return order;

  // Ids are nearly dense unless sinks took many particles: then a table is several times faster than a sort.
  const std::size_t top = *std::max_element(id.begin(), id.end());
  if (top < 4 * id.size()) {
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> place_of(top + 1, none);
    bool unique = true;
    for (std::size_t i = 0; i < id.size(); ++i) {
      unique = unique && place_of[id[i]] == none;
      place_of[id[i]] = static_cast<std::uint32_t>(i);
    }
    if (unique) {
      std::copy_if(place_of.begin(), place_of.end(), order.begin(), [](std::uint32_t place) { return place != none; });
      return order;
    }
  }
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return id[a] < id[b]; });
  return order;
}

std::uint64_t state_hash(const Fields& fields) {
  const std::vector<std::uint32_t> order = order_by_id(fields.id);
  const std::unique_ptr<XXH3_state_t, HashDeleter> state(XXH3_createState());
  if (!state) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  for_each_field(fields, [&](const FieldRow& row, const auto& array) {
    if (!is_saved(row.kind) || array.empty()) return;
    if (array.size() != order.size()) {
      throw std::logic_error("state hash: " + std::string(row.name) + " has another length than id");
    }
    XXH3_64bits_update(state.get(), row.name.data(), row.name.size());
    using Value = typename std::remove_cvref_t<decltype(array)>::value_type;
    hash_in_order(state.get(), std::span(array), order, hashed_bytes<Value>(row));
  });
  return XXH3_64bits_digest(state.get());
}

std::uint64_t array_hash(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::string hash_text(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; hash >>= 4) text[i] = "0123456789abcdef"[hash & 15];
  return text;
}

}  // namespace curlew
