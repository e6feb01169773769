#include "app/numbers.h"

#include <charconv>
#include <cmath>

#include "sim/core/error.h"
#include "sim/scene/json.h"

namespace curlew {

double parse_particle_number(const std::string& option, const std::string& text) {
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [end, status] = std::from_chars(text.data(), last, value);
  const std::string unit(end, last);
  const double scale = unit.empty() ? 1 : unit == "k" ? 1e3 : unit == "M" ? 1e6 : 0;
  if (status != std::errc() || scale == 0 || !(value * scale >= 1) || !std::isfinite(value)) {
    throw InputError(option + " is " + in_quotes(text) + ", expected a number such as 24389, 24k, 1.2M or 1e5");
  }
  return value * scale;
}

}  // namespace curlew
