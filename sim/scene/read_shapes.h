// The part of the scene reader that reads shapes. Both functions throw InputError.
#pragma once

#include <span>
#include <string_view>

#include "sim/scene/json_place.h"
#include "sim/scene/scene.h"

namespace curlew {

// Reads the one shape of an object such as {"box": {...}, "velocity": [...]}; `others` are the keys that may stand
// beside the shape.
Shape read_shape(const JsonPlace&, std::initializer_list<std::string_view> others, int dimension);

// {"min": [...], "max": [...]} with min below max on every axis.
Box read_box(const JsonPlace&, int dimension);

// The same where other keys stand beside min and max and were checked before.
Box read_corners(const JsonPlace&, int dimension);

}  // namespace curlew
