// The settings of the turbulence models that the papers compare.
#pragma once

#include <span>

#include "sim/core/params.h"

namespace curlew {

struct TurbulencePreset {
  const char* name;             // "VR 1.0"
  double alpha, nu_t, epsilon;  // 1, m^2/s, m/s
  const char* doc;              // with the paper
  double amplitude = 0;         // s/m
  int levels = 0;               // of sub-particles
};

std::span<const TurbulencePreset> turbulence_presets();

// The parameters with the strengths of all models as the preset has them, and the micropolar model in its
// inviscid form, which 0 switches off. All else stays.
Parameters with_preset(Parameters parameters, const TurbulencePreset& preset);

// The preset that gives these strengths; null where there is none.
const TurbulencePreset* preset_of(const Parameters& parameters);

}  // namespace curlew
