#include "app/methods.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/core/error.h"
#include "sim/scene/json.h"

namespace curlew {
namespace {

struct Part {
  const char *word, *label, *after;
  const char* key;
  double Method::*strength;
};

// "sum" and "vr" share a strength, so Method::sum tells which of them a method has.
constexpr Part parts[] = {{"vr", "VR ", "", "vorticity_refinement.alpha", &Method::alpha},
                          {"sum", "VR ", " sum", "vorticity_refinement.alpha", &Method::alpha},
                          {"mp", "MP ", "", "micropolar.nu_t", &Method::nu_t},
                          {"vc", "VC ", "", "vorticity_confinement.epsilon", &Method::epsilon},
                          {"wt", "WT ", "", "wavelet.amplitude", &Method::wavelet}};

bool has(const Method& method, const Part& part) {
  const bool is_sum = part.word == std::string("sum");
  return method.*part.strength != 0 && (part.strength != &Method::alpha || is_sum == method.sum);
}

[[noreturn]] void refuse(const std::string& text) {
  throw InputError("--methods is " + in_quotes(text) +
                   ", expected dfsph, vr1.0, sum1.0, mp0.05, vc0.1, wt0.02 with any strength, or a sum such as "
                   "vr1.0+mp0.05");
}

void add_part(Method& method, const std::string& word, const std::string& text) {
  for (const Part& part : parts) {
    if (!word.starts_with(part.word)) continue;
    Parameters checked;
    const ParameterRow& row = parameter_row(part.key);
    const std::string number = word.substr(std::string(part.word).size());
    if (number.empty() || method.*part.strength != 0) refuse(text);
    set_parameter(checked, row, number, "--methods " + text);
    if (!(row.get(checked) > 0)) refuse(text);
    method.*part.strength = row.get(checked);
    method.sum = method.sum || part.word == std::string("sum");
    return;
  }
  refuse(text);
}

Method parse_method(const std::string& text) {
  Method method;
  if (text == "dfsph") return method;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    add_part(method, text.substr(begin, end - begin), text);
    begin = end + 1;
  }
  return method;
}

std::string strength_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return std::abs(std::stod(text) - value) < 1e-12 ? text : number_text(value);
}

}  // namespace

std::vector<Method> parse_methods(const std::vector<std::string>& texts) {
  std::vector<Method> methods;
  for (const std::string& text : texts) {
    const Method method = parse_method(text);
    if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
  }
  return methods;
}

std::string method_label(const Method& method) {
  std::string label;
  for (const Part& part : parts) {
    if (!has(method, part)) continue;
    label += (label.empty() ? "" : " + ") + (part.label + strength_text(method.*part.strength)) + part.after;
  }
  return label.empty() ? "DFSPH" : label;
}

std::string method_name(const Method& method) {
  std::string name;
  for (const Part& part : parts) {
    if (has(method, part)) name += (name.empty() ? "" : "+") + (part.word + number_text(method.*part.strength));
  }
  return name.empty() ? "dfsph" : name;
}

void apply_method(Parameters& parameters, const Method& method) {
  parameters.vorticity_refinement.alpha = method.alpha;
  parameters.micropolar.nu_t = method.nu_t;
  parameters.vorticity_confinement.epsilon = method.epsilon;
  parameters.wavelet.amplitude = method.wavelet;
  if (method.sum) {
    parameters.vorticity_refinement.reconstruction = VorticityRefinementParameters::reconstruction_t::sum;
  }
}

void check_free(const std::vector<std::string>& settings, std::vector<std::string> varied) {
  for (const Part& part : parts) varied.emplace_back(part.key);
  for (const std::string& setting : settings) {
    const std::string key = setting.substr(0, setting.find('='));
    if (std::find(varied.begin(), varied.end(), key) != varied.end()) {
      throw InputError("--set gives " + key + ", which this benchmark varies itself; leave it out");
    }
  }
}

}  // namespace curlew
