// Where the papers say that a parameter is too high: the part of the slider's track from there on is tinted, and the
// tool tip says why.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sim/core/params.h"

namespace curlew {

struct Danger {
  std::string_view key;  // of the parameter
  double from;           // in the parameter's unit
  int level;             // 1: does not calm down; 2: worse
  const char* why;       // one sentence, with the paper
};

std::span<const Danger> dangers();

// Of more than three decades: a slider over them is of use only in logarithms.
bool logarithmic(const ParameterRow& row);

// Tints the track of the slider that was drawn last, which is this parameter's.
void tint_dangers(const ParameterRow& row);

// Lines in the tool tip that is open.
void tell_dangers(const ParameterRow& row);

}  // namespace curlew
