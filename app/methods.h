// Turbulence methods as the benches name them on the command line: "dfsph" (none), "vr1.0" (vorticity refinement with
// alpha 1), "sum1.0" (the same by the sum of the paper), "mp0.05" (micropolar, nu_t 0.05), "vc0.1" (vorticity
// confinement, epsilon 0.1), "wt0.02" (wavelet turbulence, amplitude 0.02), and sums such as "vr1.0+mp0.05".
#pragma once

#include <string>
#include <vector>

#include "sim/core/params.h"

namespace curlew {

struct Method {
  double alpha = 0, nu_t = 0, epsilon = 0, wavelet = 0;
  bool sum = false;  // else the reconstruction stays as it is

  bool operator==(const Method&) const = default;
  bool is_plain() const { return *this == Method{}; }
};

// All of --methods, none of them twice. Throws InputError.
std::vector<Method> parse_methods(const std::vector<std::string>& texts);

// "DFSPH", "VR 1.00", "VR 1.00 sum + MP 0.05".
std::string method_label(const Method& method);
// "dfsph", "vr1", "sum1+mp0.05": what parse_methods reads back, fit for a file's name.
std::string method_name(const Method& method);

// Switches on what the method has and off what it has not.
void apply_method(Parameters& parameters, const Method& method);

// Throws InputError where --set sets what the bench itself varies: the methods' strengths and the keys given.
void check_free(const std::vector<std::string>& settings, std::vector<std::string> varied);

}  // namespace curlew
