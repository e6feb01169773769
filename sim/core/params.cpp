#include "sim/core/params.h"

#include <charconv>
#include <cmath>

#include "sim/core/error.h"
#include "sim/core/nearest_name.h"

namespace curlew {
namespace {

using Type = ParameterRow::Type;

std::vector<std::string> split_names(std::string_view list) {
  std::vector<std::string> names;
  while (!list.empty()) {
    const auto comma = list.find(',');
    names.emplace_back(list.substr(0, comma));
    list = comma == std::string_view::npos ? "" : list.substr(list.find_first_not_of(' ', comma + 1));
  }
  return names;
}

std::vector<ParameterRow> make_table() {
  [[maybe_unused]] constexpr bool live = true, rebuild = false;
  std::vector<ParameterRow> table;
#define CURLEW_GET [](const Parameters& p) { return static_cast<double>(p.*in_group.*of); }
#define CURLEW_SET \
  [](Parameters& p, double v) { p.*in_group.*of = static_cast<std::remove_reference_t<decltype(p.*in_group.*of)>>(v); }
#define CURLEW_ROW(member, ...)                                                              \
  {                                                                                          \
    static constexpr auto of = &Group::member;                                               \
    table.push_back({name + "." #member, name, title, __VA_ARGS__, CURLEW_GET, CURLEW_SET}); \
  }
#define CURLEW_REAL(member, value, smin, smax, min, max, unit, symbol, when, doc) \
  CURLEW_ROW(member, Type::real, value, smin, smax, min, max, unit, symbol, doc, when, {})
#define CURLEW_COUNT(member, value, smin, smax, min, max, unit, symbol, when, doc) \
  CURLEW_ROW(member, Type::count, value, smin, smax, min, max, unit, symbol, doc, when, {})
#define CURLEW_FLAG(member, value, symbol, when, doc) \
  CURLEW_ROW(member, Type::flag, value, 0, 1, 0, 1, "1", symbol, doc, when, {})
#define CURLEW_CHOICE(member, value, symbol, when, doc, ...)                                                       \
  {                                                                                                                \
    const auto names = split_names(#__VA_ARGS__);                                                                  \
    const double last = static_cast<double>(names.size() - 1);                                                     \
    CURLEW_ROW(member, Type::choice, static_cast<double>(Group::member##_t::value), 0, last, 0, last, "1", symbol, \
               doc, when, names)                                                                                   \
  }
#define CURLEW_GROUP(group, type, rows, heading)                \
  {                                                             \
    using Group = type;                                         \
    static constexpr auto in_group = &Parameters::group;        \
    const std::string name = #group, title = heading;           \
    rows(CURLEW_REAL, CURLEW_COUNT, CURLEW_FLAG, CURLEW_CHOICE) \
  }
  CURLEW_PARAMETER_GROUPS(CURLEW_GROUP)
  return table;
}

double parse_number(const std::string& text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc() && end == text.data() + text.size() ? value : std::nan("");
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

// The value that `text` stands for in this row, or NaN.
double parse_value(const ParameterRow& row, const std::string& text) {
  if (row.type == Type::flag) {
    if (text == "true" || text == "on" || text == "1") return 1;
    if (text == "false" || text == "off" || text == "0") return 0;
    return std::nan("");
  }
  if (row.type == Type::choice) {
    for (std::size_t i = 0; i < row.names.size(); ++i) {
      if (row.names[i] == text) return static_cast<double>(i);
    }
    return std::nan("");
  }
  return parse_number(text);
}

std::string expectation(const ParameterRow& row) {
  switch (row.type) {
    case Type::flag:
      return "true or false";
    case Type::choice:
      return "one of: " + joined(row.names);
    case Type::count:
      return "a whole number from " + number_text(row.min) + " to " + number_text(row.max);
    case Type::real:
      break;
  }
  const std::string unit = row.unit == "1" ? "" : " " + row.unit;
  return "a number from " + number_text(row.min) + " to " + number_text(row.max) + unit;
}

}  // namespace

const std::vector<ParameterRow>& parameter_table() {
  static const std::vector<ParameterRow> table = make_table();
  return table;
}

const ParameterRow& parameter_row(std::string_view key) {
  std::vector<std::string> keys;
  for (const auto& row : parameter_table()) {
    if (row.key == key) return row;
    keys.push_back(row.key);
  }
  const std::string near = nearest_name(std::string(key), keys);
  throw InputError("there is no parameter \"" + std::string(key) + "\"" +
                   (near.empty() ? "; `curlew params` lists them" : "; did you mean \"" + near + "\"?"));
}

void set_parameter(Parameters& parameters, const ParameterRow& row, double value, const std::string& place) {
  const bool whole = row.type == Type::real || value == std::floor(value);
  if (!std::isfinite(value) || value < row.min || value > row.max || !whole) {
    throw InputError(place + ": " + row.key + " is " + (std::isfinite(value) ? number_text(value) : "not a number") +
                     ", expected " + expectation(row));
  }
  row.set(parameters, value);
}

void set_parameter(Parameters& parameters, const ParameterRow& row, const std::string& text, const std::string& place) {
  const double value = parse_value(row, text);
  if (std::isnan(value)) {
    throw InputError(place + ": " + row.key + " is \"" + text + "\", expected " + expectation(row));
  }
  set_parameter(parameters, row, value, place);
}

std::string parameter_text(const ParameterRow& row, double value) {
  if (row.type == Type::flag) return value != 0 ? "true" : "false";
  if (row.type == Type::choice) return row.names.at(static_cast<std::size_t>(value));
  return number_text(value);
}

std::string parameter_text(const Parameters& parameters, const ParameterRow& row) {
  return parameter_text(row, row.get(parameters));
}

std::string number_text(double value) {
  char buffer[32];
  const double size = std::abs(value);
  // 100000 is kinder than 1e+05.
  const bool plain = size >= 1e-3 && size < 1e9;
  const auto result = plain ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                            : std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, result.ptr);
}

}  // namespace curlew
