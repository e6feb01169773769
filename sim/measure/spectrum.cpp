#include "sim/measure/spectrum.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <string>
#include <unsupported/Eigen/FFT>

#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace curlew {
namespace {

constexpr double reach_in_spacings = 2;
constexpr int terms = 10;  // of a parabola in three dimensions

using Complex = std::complex<double>;
using Moments = Eigen::Matrix<double, terms, terms>;
using Terms = Eigen::Matrix<double, terms, 1>;
using Values = Eigen::Matrix<double, terms, 3>;

// Particles sorted into cells as wide as the reach, or a little wider, in a periodic cube.
class Bins {
 public:
  Bins(std::span<const Vec3> position, double reach, double side)
      : side_(side), across_(static_cast<int>(side / reach)), order_(position.size()) {
    std::vector<std::size_t> cell(position.size());
    for (std::size_t i = 0; i < cell.size(); ++i) cell[i] = index(cell_of(to_double(position[i])));
    begin_.assign(static_cast<std::size_t>(across_) * across_ * across_ + 1, 0);
    for (const std::size_t c : cell) ++begin_[c + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < cell.size(); ++i) order_[next[cell[i]]++] = i;
  }

  // f(particle) for those in the 27 cells around a place.
  template <class F>
  void around(Vec3d x, F&& f) const {
    const std::array<int, 3> c = cell_of(x);
    for (int n = 0; n < 27; ++n) {
      const std::size_t k = index({c[0] + n / 9 - 1, c[1] + n / 3 % 3 - 1, c[2] + n % 3 - 1});
      for (std::size_t at = begin_[k]; at < begin_[k + 1]; ++at) f(order_[at]);
    }
  }

 private:
  std::array<int, 3> cell_of(Vec3d x) const {
    const auto along = [&](double v) { return static_cast<int>(std::floor(v / side_ * across_)); };
    return {along(x.x), along(x.y), along(x.z)};
  }
  std::size_t index(std::array<int, 3> c) const {
    std::size_t at = 0;
    for (const int v : c) at = at * across_ + static_cast<std::size_t>((v % across_ + across_) % across_);
    return at;
  }

  double side_;
  int across_;
  std::vector<std::size_t> order_, begin_;
};

Terms terms_of(Vec3d x) {
  Terms t;
  t << 1, x.x, x.y, x.z, x.x * x.x, x.y * x.y, x.z * x.z, x.y * x.z, x.z * x.x, x.x * x.y;
  return t;
}

// Value at `place` of the parabola that fits the particles around it best; NaN where there are too few.
Vec3d fitted_velocity(const Bins& bins, std::span<const Vec3> position, std::span<const Vec3> velocity, Vec3d place,
                      double reach, double side) {
  Moments moments = Moments::Zero();
  Values values = Values::Zero();
  int found = 0;
  bins.around(place, [&](std::size_t j) {
    Vec3d x = to_double(position[j]) - place;
    for (int axis = 0; axis < 3; ++axis) x[axis] = (x[axis] - side * std::nearbyint(x[axis] / side)) / reach;
    const double q2 = dot(x, x);
    if (q2 >= 1) return;
    const double q = std::sqrt(q2), weight = std::pow(1 - q, 4) * (1 + 4 * q);
    const Terms t = terms_of(x);
    moments.selfadjointView<Eigen::Lower>().rankUpdate(t, weight);
    for (int axis = 0; axis < 3; ++axis) values.col(axis) += weight * velocity[j][axis] * t;
    ++found;
  });
  if (found < terms) return {NAN, NAN, NAN};
  // A little on all but the constant, for particles that lie so that a parabola is not told from a line.
  for (int k = 1; k < terms; ++k) moments(k, k) += 1e-9 * moments(0, 0);
  const Values fit = moments.selfadjointView<Eigen::Lower>().ldlt().solve(values);
  return {fit(0, 0), fit(0, 1), fit(0, 2)};
}

// In place, along all three axes of a cube, without a factor.
void fourier_transform(std::vector<Complex>& cube, int across) {
  const auto n = static_cast<std::size_t>(across);
  Eigen::FFT<double> fft;
  std::vector<Complex> line(n), transformed(n);
  for (const std::size_t stride : {std::size_t{1}, n, n * n}) {
    for (std::size_t row = 0; row < n * n; ++row) {
      Complex* first = &cube[row / stride * stride * n + row % stride];
      for (std::size_t k = 0; k < n; ++k) line[k] = first[k * stride];
      fft.fwd(transformed, line);
      for (std::size_t k = 0; k < n; ++k) first[k * stride] = transformed[k];
    }
  }
}

void add_energy(const std::vector<Complex>& modes, int across, std::vector<double>& shells) {
  const auto wave = [&](int k) { return static_cast<double>(2 * k <= across ? k : k - across); };
  const double share = 1 / std::pow(across, 3);
  std::size_t at = 0;
  for (int k = 0; k < across; ++k) {
    for (int j = 0; j < across; ++j) {
      for (int i = 0; i < across; ++i, ++at) {
        const Vec3d n{wave(i), wave(j), wave(k)};
        shells[static_cast<std::size_t>(length(n) + 0.5)] += 0.5 * std::norm(share * modes[at]);
      }
    }
  }
}

double compensated(const Spectrum& s, std::size_t shell) {
  return s.energy[shell] * std::pow(s.wave_number(shell), 5.0 / 3);
}

}  // namespace

VelocityGrid make_velocity_grid(int across, double side) {
  const auto n = static_cast<std::size_t>(across);
  return {across, side, std::vector<Vec3d>(n * n * n)};
}

VelocityGrid velocities_on_grid(std::span<const Vec3> position, std::span<const Vec3> velocity, double spacing,
                                int across, double side) {
  const double reach = reach_in_spacings * spacing;
  if (side < 3 * reach) {
    throw InputError("a cube is " + std::to_string(side / spacing) + " spacings wide, expected at least 6");
  }
  const Bins bins(position, reach, side);
  VelocityGrid grid = make_velocity_grid(across, side);
  parallel_for(grid.velocity.size(), [&](std::size_t node) {
    const auto n = static_cast<std::size_t>(across);
    const Vec3d place =
        grid.place(static_cast<int>(node % n), static_cast<int>(node / n % n), static_cast<int>(node / (n * n)));
    grid.velocity[node] = fitted_velocity(bins, position, velocity, place, reach, side);
  });
  for (const Vec3d& v : grid.velocity) {
    if (std::isnan(v.x)) throw InputError("a node of the grid has too few particles around it, expected at least 10");
  }
  return grid;
}

double Spectrum::total() const { return step * std::accumulate(energy.begin(), energy.end(), 0.0); }

Spectrum energy_spectrum(const VelocityGrid& grid) {
  Spectrum spectrum{2 * std::numbers::pi / grid.side, {}};
  spectrum.energy.assign(static_cast<std::size_t>(std::sqrt(3.0) * (grid.across / 2) + 0.5) + 1, 0);
  std::vector<Complex> modes(grid.velocity.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(grid.velocity.begin(), grid.velocity.end(), modes.begin(), [&](Vec3d v) { return v[axis]; });
    fourier_transform(modes, grid.across);
    add_energy(modes, grid.across, spectrum.energy);
  }
  for (double& energy : spectrum.energy) energy /= spectrum.step;
  return spectrum;
}

PowerLaw fit_power_law(const Spectrum& spectrum, std::size_t first, std::size_t last) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = first; k <= std::min(last, spectrum.energy.size() - 1); ++k) {
    if (!(spectrum.energy[k] > 0)) continue;
    const double a = std::log(spectrum.wave_number(k)), b = std::log(spectrum.energy[k]);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  if (n < 2) return {NAN, NAN};
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {slope, std::exp((y - slope * x) / n)};
}

double compensated_level(const Spectrum& spectrum, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t k = first; k <= last; ++k) sum += std::log(compensated(spectrum, k));
  return std::exp(sum / static_cast<double>(last - first + 1));
}

std::size_t departure(const Spectrum& spectrum, std::size_t first, std::size_t last, double factor) {
  const double level = compensated_level(spectrum, first, last);
  for (std::size_t k = first; k < spectrum.energy.size(); ++k) {
    const double ratio = compensated(spectrum, k) / level;
    if (!(ratio < factor && ratio > 1 / factor)) return k;
  }
  return spectrum.energy.size();
}

double turnover_time(const Spectrum& spectrum) {
  double energy = 0, over_k = 0;
  for (std::size_t k = 1; k < spectrum.energy.size(); ++k) {
    energy += spectrum.energy[k] * spectrum.step;
    over_k += spectrum.energy[k] * spectrum.step / spectrum.wave_number(k);
  }
  const double speed2 = 2.0 / 3 * energy;
  return std::numbers::pi / (2 * speed2) * over_k / std::sqrt(speed2);
}

}  // namespace curlew
