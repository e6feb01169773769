#include "app/gui/presets.h"

namespace curlew {
namespace {

// The paper names no strength. Measured (README, "Turbulence"): with this one a splash is livelier and calms down.
constexpr double preset_amplitude = 0.02;

constexpr TurbulencePreset presets[] = {
    {"off", 0, 0, 0, "DFSPH alone, what all papers compare with."},
    {"VR 1.0", 1, 0, 0, "Vorticity refinement that gives back all that was lost: Liu et al. 2020 recommend it."},
    {"MP 0.05", 0, 0.05, 0, "Micropolar fluid as in Bender et al. 2018 (Fig. 5), and as Liu et al. 2020 compare it."},
    {"MP 0.2", 0, 0.2, 0,
     "Micropolar fluid, stronger: Bender et al. 2018 (Fig. 6, 7). In Liu et al. 2020 (Fig. 7) it does not calm down."},
    {"VC 0.1", 0, 0, 0.1, "Vorticity confinement of Macklin & Mueller 2013 as Bender et al. 2018 compare it (Fig. 3)."},
    {"VR with MP", 1, 0.05, 0,
     "Vorticity refinement and a micropolar fluid together, each as Liu et al. 2020 (section 5) choose it; the papers "
     "do not combine them."},
    {"wavelets", 0, 0, 0,
     "Wavelet turbulence and vortex sub-particles: eddies too small for the particles (Fujisawa et al. 2011).",
     preset_amplitude, 3},
};

using Model = MicropolarParameters::model_t;

}  // namespace

std::span<const TurbulencePreset> turbulence_presets() { return presets; }

Parameters with_preset(Parameters parameters, const TurbulencePreset& preset) {
  parameters.vorticity_refinement.alpha = preset.alpha;
  parameters.micropolar.nu_t = preset.nu_t;
  parameters.micropolar.model = Model::inviscid;
  parameters.vorticity_confinement.epsilon = preset.epsilon;
  parameters.wavelet.amplitude = preset.amplitude;
  parameters.sub_particles.levels = preset.levels;
  return parameters;
}

const TurbulencePreset* preset_of(const Parameters& parameters) {
  if (parameters.micropolar.model != Model::inviscid) return nullptr;
  for (const TurbulencePreset& preset : presets) {
    if (parameters.vorticity_refinement.alpha == preset.alpha && parameters.micropolar.nu_t == preset.nu_t &&
        parameters.vorticity_confinement.epsilon == preset.epsilon &&
        parameters.wavelet.amplitude == preset.amplitude && parameters.sub_particles.levels == preset.levels) {
      return &preset;
    }
  }
  return nullptr;
}

}  // namespace curlew
