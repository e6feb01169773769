// Turbulence that the particles are too coarse to carry, put in where the flow is turbulent (Fujisawa et al. 2011, on
// turbulent flow by particles and wavelets with vortex sub-particles, section 3.2 and 3.3; after Kim, Thuerey, James &
// Gross 2008, "Wavelet Turbulence for Fluid Simulation").
//
// Wavelet energy. The paper's transform, sum u_j psi / (sqrt(s) sum psi) (Eq. 6), is far from zero in a uniform flow,
// and its denominator can vanish. Ours is
//   u^_i = kappa s^2 sum_j (u_j - u_i - G_i (x_j - x_i)) psi_ij / sum_j |psi_ij| r_ij^2,
//   psi = (D - q^2) exp(-q^2 / 2),  q = r / s,      e^ = |u^|^2 / 2,
// with the velocity gradient G_i fitted to the neighbours by least squares (weights exp(-q^2 / 2)). So u^ is zero in
// every linear flow, as the continuous transform is: uniform, rotating, sheared, also at a surface and for a handful of
// neighbours. With kappa = |int psi q^2| / int |psi|, u^ is the transform over int |psi| for waves long against s,
// however few neighbours sample the wavelet.
#pragma once

#include <array>

#include "sim/core/world.h"

namespace curlew {

// The pass: fills in wavelet_energy, m^2/s^2.
void find_wavelet_energy(World& world);

// The pass: accelerates by A e^ y(x) / tau (the paper's force is A rho e^ y / dt, Eq. 9), e^ less wavelet.threshold, y
// the curl of wavelet noise over wavelet.octaves (Eq. 8).
void add_wavelet_turbulence(World& world);

// The pass: moves the noise on by wavelet.renewal cells in the turnover time of an eddy, so that it drives no standing
// jets.
void drift_wavelet_noise(World& world);

// Throws InputError where wavelet.tile is no size of a tile.
std::shared_ptr<const WaveletNoise> make_wavelet_noise(const WaveletParameters& parameters, std::uint64_t seed);

// y in the world's coordinates, at one moment.
class TurbulenceField {
 public:
  // Octaves of cells as wide as `finest` (m) and its doubles; `moved` in cells of the coarsest.
  TurbulenceField(const WaveletNoise& noise, double finest, int octaves, double moved, int dimension);
  Vec3 at(Vec3 x) const;  // x in m

 private:
  static constexpr std::size_t most_octaves = 8;
  const WaveletNoise* noise_;
  double cells_per_metre_;
  std::array<Vec3d, most_octaves> offset_;
  std::size_t octaves_;
  bool flat_;
};

}  // namespace curlew
