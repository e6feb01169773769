// The state hash: it sees every bit of the state and nothing else.
#include "sim/measure/state_hash.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <numeric>
#include <set>

#include "tests/io/sample_fields.h"

using namespace curlew;
using namespace curlew::test;

namespace {

Fields permuted(const Fields& fields, const std::vector<std::size_t>& order) {
  Fields result = fields;
  for_each_field(result, [&]<class T>(const FieldRow&, Array<T>& array) {
    const Array<T> before = array;
    for (std::size_t i = 0; i < array.size(); ++i) array[i] = before[order[i]];
  });
  return result;
}

}  // namespace

TEST_CASE("the state hash does not depend on the order in memory", "[hash]") {
  for (const std::size_t particles : {1u, 2u, 1023u, 1024u, 5000u}) {
    const Fields fields = sample_fields(particles);
    std::vector<std::size_t> order(particles);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::reverse(order.begin(), order.end());
    CHECK(state_hash(permuted(fields, order)) == state_hash(fields));
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(particles / 3), order.end());
    CHECK(state_hash(permuted(fields, order)) == state_hash(fields));
  }
}

TEST_CASE("the state hash sees every bit of every kept field", "[hash]") {
  Fields fields = sample_fields(1500);
  std::set<std::uint64_t> hashes = {state_hash(fields)};
  std::size_t flips = 0;
  for_each_field(fields, [&]<class T>(const FieldRow& row, Array<T>& array) {
    if (row.kind != FieldKind::kept) return;
    INFO(row.name);
    for (const std::size_t i : {0u, 1u, 777u, 1499u}) {
      auto* bytes = reinterpret_cast<unsigned char*>(&array[i]);
      const std::size_t counted = std::is_same_v<T, Vec3> ? 96 : 8 * sizeof(T);
      for (std::size_t bit = 0; bit < counted; ++bit) {
        const auto mask = static_cast<unsigned char>(1u << bit % 8);
        bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ mask);
        hashes.insert(state_hash(fields));
        bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ mask);
        ++flips;
      }
    }
  });
  CHECK(hashes.size() == flips + 1);
}

TEST_CASE("the state hash ignores the spare number of vectors and scratch fields", "[hash]") {
  Fields fields = sample_fields(100);
  const std::uint64_t hash = state_hash(fields);
  fields.position[3].w = 5;
  fields.density.assign(100, 1000.0f);
  CHECK(state_hash(fields) == hash);
}

TEST_CASE("the state hash tells swapped particles, fields and counts apart", "[hash]") {
  const Fields fields = sample_fields(100);
  std::set<std::uint64_t> hashes = {state_hash(fields), state_hash(Fields{}), state_hash(sample_fields(99))};
  Fields swapped = fields;
  std::swap(swapped.id[4], swapped.id[5]);
  hashes.insert(state_hash(swapped));
  swapped = fields;
  std::swap(swapped.density_stiffness, swapped.divergence_stiffness);
  hashes.insert(state_hash(swapped));
  swapped = fields;
  swapped.density_stiffness.clear();  // not in use
  hashes.insert(state_hash(swapped));
  CHECK(hashes.size() == 6);
  swapped.velocity.pop_back();
  CHECK_THROWS_WITH(state_hash(swapped), "state hash: velocity has another length than id");
}

TEST_CASE("particles are ordered by id, dense or not", "[hash]") {
  using Order = std::vector<std::uint32_t>;
  CHECK(order_by_id(Order{}) == Order{});
  CHECK(order_by_id(Order{2, 0, 1}) == Order{1, 2, 0});
  CHECK(order_by_id(Order{9, 0, 4}) == Order{1, 2, 0});
  CHECK(order_by_id(Order{4000000000u, 7, 4294967295u}) == Order{1, 0, 2});
  CHECK(order_by_id(Order{1, 0, 1, 0}) == Order{1, 3, 0, 2});
}

TEST_CASE("hashes have sixteen digits", "[hash]") {
  CHECK(hash_text(0) == "0000000000000000");
  CHECK(hash_text(0x0123456789abcdef) == "0123456789abcdef");
  CHECK(hash_text(~std::uint64_t{0}) == "ffffffffffffffff");
  // XXH3 of nothing, from the reference implementation's own test values.
  CHECK(hash_text(array_hash({})) == "2d06800538d394c2");
}
