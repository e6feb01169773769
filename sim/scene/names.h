// Names that scene files use and that more than the reader needs.
#pragma once

#include <span>
#include <string_view>

namespace curlew {

// The colour maps that the renderer knows.
std::span<const std::string_view> colour_map_names();

// "particles", "water", "fast-water": in the order of LookStyle.
std::span<const std::string_view> look_style_names();

// "slip", "no-slip", "open": in the order of WallKind.
std::span<const std::string_view> wall_kind_names();

// "x-", "x+", "y-", "y+", "z-", "z+": in the order of Domain::walls.
std::span<const std::string_view> wall_names(int dimension);

// "constant", "taylor_green", "rotation", "shear_wave", "gresho_chan", "lamb_oseen": in the order of
// InitialVelocity::Field.
std::span<const std::string_view> velocity_field_names();

// "pressure", "velocity", "water_height": in the order of Probe::Quantity.
std::span<const std::string_view> probe_quantity_names();

}  // namespace curlew
