// The parameter table and what it says to users.
#include "sim/core/params.h"

#include <catch2/catch.hpp>
#include <set>

#include "sim/core/error.h"

using namespace curlew;

namespace {

std::string error_of(const std::string& key, const std::string& value) {
  Parameters parameters;
  try {
    set_parameter(parameters, parameter_row(key), value, "here");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("each row is complete and consistent", "[params]") {
  std::set<std::string> keys;
  const Parameters defaults;
  for (const ParameterRow& row : parameter_table()) {
    INFO(row.key);
    CHECK(keys.insert(row.key).second);
    CHECK(row.key.starts_with(row.group + "."));
    CHECK(row.min <= row.slider_min);
    CHECK(row.slider_min < row.slider_max);
    CHECK(row.slider_max <= row.max);
    CHECK(row.default_value >= row.min);
    CHECK(row.default_value <= row.max);
    CHECK(row.get(defaults) == row.default_value);
    CHECK(row.doc.size() > 20);
    CHECK(row.doc.back() == '.');
    CHECK_FALSE(row.unit.empty());
  }
}

TEST_CASE("every parameter can be set, from a number and from text, and reads back", "[params]") {
  for (const ParameterRow& row : parameter_table()) {
    INFO(row.key);
    for (double value : {row.min, row.max, row.default_value}) {
      Parameters parameters;
      set_parameter(parameters, row, value, "test");
      CHECK(row.get(parameters) == value);
      Parameters again;
      set_parameter(again, row, parameter_text(parameters, row), "test");
      CHECK(row.get(again) == value);
    }
  }
}

TEST_CASE("wrong keys and values give one helpful sentence", "[params]") {
  CHECK_THROWS_WITH(parameter_row("viscosity.mu"),
                    "there is no parameter \"viscosity.mu\"; did you mean \"viscosity.nu\"?");
  CHECK_THROWS_WITH(parameter_row("nu"), "there is no parameter \"nu\"; did you mean \"viscosity.nu\"?");
  CHECK_THROWS_WITH(parameter_row("kangaroo"), "there is no parameter \"kangaroo\"; `curlew params` lists them");
  CHECK(error_of("viscosity.nu", "wet") == "here: viscosity.nu is \"wet\", expected a number from 0 to 100 m^2/s");
  CHECK(error_of("viscosity.nu", "-1") == "here: viscosity.nu is -1, expected a number from 0 to 100 m^2/s");
  CHECK(error_of("viscosity.nu", "inf") == "here: viscosity.nu is not a number, expected a number from 0 to 100 m^2/s");
  CHECK(error_of("viscosity.nu", "nan") == "here: viscosity.nu is \"nan\", expected a number from 0 to 100 m^2/s");
  CHECK(error_of("viscosity.nu", "1e") == "here: viscosity.nu is \"1e\", expected a number from 0 to 100 m^2/s");
  CHECK(error_of("pressure.max_iterations", "2.5") ==
        "here: pressure.max_iterations is 2.5, expected a whole number from 1 to 100000");
  CHECK(error_of("pressure.warm_start", "maybe") == "here: pressure.warm_start is \"maybe\", expected true or false");
  CHECK(error_of("viscosity.form", "tensor") == "here: viscosity.form is \"tensor\", expected one of: scalar, vector");
}
