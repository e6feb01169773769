// The parameters as structs that solvers read, and the table of them that everybody else reads.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/core/parameters.def.h"

namespace curlew {

// A choice is an enum inside its group: viscosity.form has the type ViscosityParameters::form_t.
#define CURLEW_REAL(member, default_value, ...) double member = default_value;
#define CURLEW_COUNT(member, default_value, ...) int member = default_value;
#define CURLEW_FLAG(member, default_value, ...) bool member = default_value;
#define CURLEW_CHOICE(member, default_value, symbol, when, doc, ...) \
  enum class member##_t : int{__VA_ARGS__};                          \
  member##_t member = member##_t::default_value;
#define CURLEW_GROUP(group, type, table, heading)                \
  struct type {                                                  \
    table(CURLEW_REAL, CURLEW_COUNT, CURLEW_FLAG, CURLEW_CHOICE) \
  };
CURLEW_PARAMETER_GROUPS(CURLEW_GROUP)
#undef CURLEW_REAL
#undef CURLEW_COUNT
#undef CURLEW_FLAG
#undef CURLEW_CHOICE
#undef CURLEW_GROUP

struct Parameters {
#define CURLEW_GROUP(group, type, table, heading) type group;
  CURLEW_PARAMETER_GROUPS(CURLEW_GROUP)
#undef CURLEW_GROUP
};

// One row of the table, read at run time. A value of any type travels as a number: a flag is 0 or 1, a choice the
// index of its name.
struct ParameterRow {
  enum class Type { real, count, flag, choice };

  std::string key;      // "pressure.density_tolerance"
  std::string group;    // "pressure"
  std::string heading;  // "Pressure (DFSPH)"
  Type type;
  double default_value;
  double slider_min, slider_max;   // for the slider
  double min, max;                 // hard limits
  std::string unit;                // "1" where there is none
  std::string symbol;              // the paper's letter, or empty
  std::string doc;                 // one sentence, with the paper
  bool live;                       // may change while running
  std::vector<std::string> names;  // of a choice

  double (*get)(const Parameters&);
  void (*set)(Parameters&, double);
};

// All rows, in the order of the table.
const std::vector<ParameterRow>& parameter_table();

// The row of a key; throws InputError with the nearest key where there is none.
const ParameterRow& parameter_row(std::string_view key);

// Sets a parameter from a number (a flag takes 0 or 1) or from text ("0.05", "true", "vector"). Both throw InputError
// where the value does not parse, is not finite or lies beyond the hard limits; `place` begins the message.
void set_parameter(Parameters&, const ParameterRow&, double value, const std::string& place);
void set_parameter(Parameters&, const ParameterRow&, const std::string& text, const std::string& place);

// "0.05", "true", "vector": what set_parameter reads back to the same value.
std::string parameter_text(const Parameters&, const ParameterRow&);
std::string parameter_text(const ParameterRow&, double value);

// A double as the shortest text that reads back to the same double.
std::string number_text(double value);

}  // namespace curlew
