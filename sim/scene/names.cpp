#include "sim/scene/names.h"

namespace curlew {

std::span<const std::string_view> colour_map_names() {
  static constexpr std::string_view names[] = {"water", "viridis", "magma", "turbo", "coolwarm", "grey"};
  return names;
}

std::span<const std::string_view> look_style_names() {
  static constexpr std::string_view names[] = {"particles", "water", "fast-water"};
  return names;
}

std::span<const std::string_view> wall_kind_names() {
  static constexpr std::string_view names[] = {"slip", "no-slip", "open"};
  return names;
}

std::span<const std::string_view> wall_names(int dimension) {
  static constexpr std::string_view names[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
  return std::span(names).first(2 * static_cast<std::size_t>(dimension));
}

std::span<const std::string_view> velocity_field_names() {
  static constexpr std::string_view names[] = {"constant",   "taylor_green", "rotation",
                                               "shear_wave", "gresho_chan",  "lamb_oseen"};
  return names;
}

std::span<const std::string_view> probe_quantity_names() {
  static constexpr std::string_view names[] = {"pressure", "velocity", "water_height"};
  return names;
}

}  // namespace curlew
