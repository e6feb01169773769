// Particles whose every kept value differs, in an order that is not that of their ids.
#pragma once

#include <cmath>
#include <cstdint>

#include "sim/core/fields.h"

namespace curlew::test {

inline void put_sample(float& value, std::size_t i, float salt) {
  value = std::sin(salt + 0.37f * static_cast<float>(i));
}
inline void put_sample(Vec3& value, std::size_t i, float salt) {
  put_sample(value.x, i, salt);
  put_sample(value.y, i, salt + 0.1f);
  put_sample(value.z, i, salt + 0.2f);
}
inline void put_sample(std::uint32_t& value, std::size_t i, float) {
  value = static_cast<std::uint32_t>(3 * (i ^ 5) + 1);  // with gaps; no two alike
}

inline Fields sample_fields(std::size_t particles) {
  Fields fields;
  float salt = 1;
  for_each_field(fields, [&](const FieldRow& row, auto& array) {
    salt += 1;
    if (row.kind != FieldKind::kept) return;
    array.resize(particles);
    for (std::size_t i = 0; i < particles; ++i) put_sample(array[i], i, salt);
  });
  return fields;
}

}  // namespace curlew::test
