// Energy spectra of the velocity in a periodic cube of side L:
//
//   E(k_n) dk = sum |v^(k)|^2 / 2  over the modes with  n - 1/2 <= |k| / dk < n + 1/2,    dk = 2 pi / L,  k_n = n dk
//   v^(k) = mean of v exp(-i k x) over the grid
//
// so that the sum of E dk over all shells is the mean of |v|^2 / 2 (Parseval). A shell is what lies on the lattice: the
// first ones hold up to a third more or fewer modes than 4 pi n^2, which an isotropic field shows as a ripple.
//
// From particles to the grid: moving least squares (Lancaster & Salkauskas 1981, Math. Comput. 37:141-158). At each
// node a parabola is fitted to the particles within two spacings, weighted by (1 - q)^4 (1 + 4 q), q = r / 2d, and its
// value at the node is taken: what is a parabola comes back exactly, whatever the disorder. Of the energy of waves 12,
// 8, 6 and 4 spacings long, 0.998, 0.99, 0.98 and 0.91 arrive (particles up to a quarter of a spacing off their
// lattice; a tenth of a per cent of all energy is spread over shorter waves). Straight lines in place of parabolas,
// first order, would leave 0.91, 0.83, 0.73 and 0.49.
#pragma once

#include <span>
#include <vector>

#include "sim/core/vec.h"

namespace curlew {

// Velocities (m/s) at the nodes of a periodic cube of side `side` (m): node (i, j, k) at (i, j, k) side / across.
struct VelocityGrid {
  int across = 0;
  double side = 0;
  std::vector<Vec3d> velocity;  // i + across (j + across k)

  std::size_t node(int i, int j, int k) const {
    const auto n = static_cast<std::size_t>(across);
    return static_cast<std::size_t>(i) + n * (static_cast<std::size_t>(j) + n * static_cast<std::size_t>(k));
  }
  Vec3d place(int i, int j, int k) const { return (side / across) * Vec3d{1.0 * i, 1.0 * j, 1.0 * k}; }
};

// Nothing in it yet.
VelocityGrid make_velocity_grid(int across, double side);

// Positions (m) count from the cube's corner and may lie beyond its faces; `spacing` is that of the particles. Throws
// InputError where the cube is less than six spacings wide or a node has too few particles around it.
VelocityGrid velocities_on_grid(std::span<const Vec3> position, std::span<const Vec3> velocity, double spacing,
                                int across, double side);

struct Spectrum {
  double step = 0;             // dk, 1/m
  std::vector<double> energy;  // E of shell n, m^3/s^2; shell 0 is the mean flow

  double wave_number(std::size_t shell) const { return step * static_cast<double>(shell); }
  double total() const;  // sum of E dk, J/kg
};

Spectrum energy_spectrum(const VelocityGrid& grid);

// Least squares of log E over log k, over the shells from `first` to `last`: E = amplitude k^slope in m^3/s^2. Shells
// without energy are left out; NaN where fewer than two are left.
struct PowerLaw {
  double slope = 0, amplitude = 0;
};
PowerLaw fit_power_law(const Spectrum& spectrum, std::size_t first, std::size_t last);

// The geometric mean of E k^(5/3) over those shells, m^(4/3)/s^2: Kolmogorov's C epsilon^(2/3) where the slope is -5/3.
double compensated_level(const Spectrum& spectrum, std::size_t first, std::size_t last);

// The first shell from `first` on whose E k^(5/3) is more than `factor` times that level over the shells from `first`
// to `last`, or less than its share 1 / factor; energy.size() where there is none.
std::size_t departure(const Spectrum& spectrum, std::size_t first, std::size_t last, double factor);

// Eddy turnover time L / u' of isotropic turbulence, s: u'^2 = 2/3 sum E dk, L = pi / (2 u'^2) sum E dk / k (Pope 2000,
// "Turbulent Flows", section 6.5).
double turnover_time(const Spectrum& spectrum);

}  // namespace curlew
