// Energy spectra: Parseval, waves in their shells, random fields of a given spectrum, and the way from particles to a
// grid.
#include "sim/measure/spectrum.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "sim/core/error.h"
#include "sim/measure/random_field.h"

using namespace curlew;

namespace {

constexpr double pi = std::numbers::pi;

template <class Field>
VelocityGrid sampled(int across, double side, Field&& field) {
  VelocityGrid grid = make_velocity_grid(across, side);
  for (int k = 0; k < across; ++k) {
    for (int j = 0; j < across; ++j) {
      for (int i = 0; i < across; ++i) grid.velocity[grid.node(i, j, k)] = field(grid.place(i, j, k));
    }
  }
  return grid;
}

double mean_energy(const VelocityGrid& grid) {
  double sum = 0;
  for (const Vec3d& v : grid.velocity) sum += dot(v, v) / 2;
  return sum / static_cast<double>(grid.velocity.size());
}

// Particles up to a quarter of a spacing off their lattice, with the velocities of a field.
struct Cloud {
  std::vector<Vec3> position, velocity;
  double spacing;

  template <class Field>
  Cloud(int across, double side, Field&& field) : spacing(side / across) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> off(0.25, 0.75);
    for (int n = 0; n < across * across * across; ++n) {
      const Vec3d cell{1.0 * (n / (across * across)), 1.0 * (n / across % across), 1.0 * (n % across)};
      position.push_back(to_float(spacing * (cell + Vec3d{off(random), off(random), off(random)})));
      velocity.push_back(to_float(field(to_double(position.back()))));
    }
  }
  VelocityGrid on_grid(int across, double side) const {
    return velocities_on_grid(position, velocity, spacing, across, side);
  }
};

}  // namespace

TEST_CASE("the shells of a spectrum add up to the mean kinetic energy") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const int across : {15, 16}) {
    const VelocityGrid grid = sampled(across, 0.7, [&](Vec3d) {
      return Vec3d{normal(random), 2 + normal(random), normal(random)};
    });
    const Spectrum spectrum = energy_spectrum(grid);
    CHECK(spectrum.step == Approx(2 * pi / 0.7));
    CHECK(spectrum.total() == Approx(mean_energy(grid)).epsilon(1e-12));
  }
}

TEST_CASE("a wave has all its energy in its shell, and a mean flow in shell 0") {
  const double side = 3;
  const auto wave = [&](Vec3d x) {
    const double phase = 2 * pi / side * (2 * x.x - 3 * x.y + 6 * x.z);  // |k| = 7
    return Vec3d{0.5 + 3 * std::cos(phase), 2 * std::cos(phase), 0};
  };
  const Spectrum spectrum = energy_spectrum(sampled(20, side, wave));
  CHECK(spectrum.step * spectrum.energy[7] == Approx(13.0 / 4));
  CHECK(spectrum.step * spectrum.energy[0] == Approx(0.125));
  CHECK(spectrum.total() == Approx(13.0 / 4 + 0.125));
  CHECK(spectrum.wave_number(7) == Approx(14 * pi / 3));
}

TEST_CASE("a random field has the spectrum that it was made with, and no divergence") {
  const double side = 2;
  const Spectrum wanted = kolmogorov_spectrum(side, 10, 1.5);
  CHECK(wanted.total() == Approx(1.5));
  const RandomField field(wanted, 4);
  const Spectrum found = energy_spectrum(sampled(24, side, [&](Vec3d x) { return field.at(x); }));
  for (std::size_t n = 0; n < found.energy.size(); ++n) {
    CHECK(found.energy[n] == Approx(n < wanted.energy.size() ? wanted.energy[n] : 0).margin(1e-12));
  }
  const PowerLaw law = fit_power_law(found, 1, 10);
  CHECK(law.slope == Approx(-5.0 / 3).epsilon(1e-9));
  CHECK(law.amplitude == Approx(compensated_level(found, 2, 9)).epsilon(1e-9));
  CHECK(departure(found, 2, 8, 2) == 11);

  const Vec3d x{0.31, 1.7, 0.02};
  const double h = 1e-5;
  const auto slope = [&](Vec3d way, int axis) {
    return (field.at(x + way)[axis] - field.at(x + -1 * way)[axis]) / (2 * h);
  };
  CHECK(slope({h, 0, 0}, 0) + slope({0, h, 0}, 1) + slope({0, 0, h}, 2) == Approx(0).margin(1e-6));
  CHECK(std::abs(slope({h, 0, 0}, 0)) > 0.1);
  CHECK_FALSE(RandomField(wanted, 5).at(x) == field.at(x));
  CHECK(length(field.at(x) + -1 * field.at(x + Vec3d{side, -side, 0})) < 1e-10);
}

TEST_CASE("a random field is isotropic: each component has a third of the energy, at every shell or so") {
  const RandomField field(kolmogorov_spectrum(1, 8, 1), 7);
  const VelocityGrid grid = sampled(20, 1, [&](Vec3d x) { return field.at(x); });
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (const Vec3d& v : grid.velocity) sum += v[axis] * v[axis] / 2;
    CHECK(sum / static_cast<double>(grid.velocity.size()) == Approx(1.0 / 3).epsilon(0.3));
  }
}

TEST_CASE("a power law is fitted in its range, and where a spectrum leaves it is found") {
  Spectrum spectrum{0.5, {9}};
  for (int n = 1; n <= 20; ++n) spectrum.energy.push_back(3 * std::pow(0.5 * n, n <= 12 ? -5.0 / 3 : -4.0));
  CHECK(fit_power_law(spectrum, 2, 12).slope == Approx(-5.0 / 3));
  CHECK(fit_power_law(spectrum, 2, 12).amplitude == Approx(3));
  CHECK(compensated_level(spectrum, 2, 12) == Approx(3));
  CHECK(fit_power_law(spectrum, 13, 20).slope == Approx(-4));
  CHECK(departure(spectrum, 2, 12, 2) == 13);
  spectrum.energy[5] *= 2.5;
  CHECK(departure(spectrum, 2, 12, 2) == 5);
  CHECK(departure(spectrum, 6, 12, 300) == 21);
  spectrum.energy[5] = 0;
  CHECK(fit_power_law(spectrum, 2, 12).slope == Approx(-5.0 / 3));
  CHECK(departure(spectrum, 2, 4, 2) == 5);
  CHECK(std::isnan(fit_power_law(spectrum, 3, 3).slope));
}

TEST_CASE("the turnover time is that of isotropic turbulence with one wave number") {
  const Spectrum spectrum{2, {0, 0, 0, 0.75}};  // all energy, 1.5 J/kg, at k = 6, so u' = 1 m/s
  CHECK(turnover_time(spectrum) == Approx(pi / 2 * 1.5 / 6));
}

TEST_CASE("particles bring a parabola to the grid as it is, whatever their disorder") {
  // Away from the faces, where it is not periodic.
  const auto parabola = [](Vec3d x) {
    return Vec3d{1 + x.x - 2 * x.y * x.z, x.y * x.y - x.z + 0.3, 2 * x.z * x.z - x.x * x.y + x.x * x.z};
  };
  const VelocityGrid grid = Cloud(12, 1, parabola).on_grid(12, 1);
  double worst = 0;
  for (int k = 3; k <= 9; ++k) {
    for (int j = 3; j <= 9; ++j) {
      for (int i = 3; i <= 9; ++i) {
        worst = std::max(worst, length(grid.velocity[grid.node(i, j, k)] - parabola(grid.place(i, j, k))));
      }
    }
  }
  CHECK(worst < 3e-6);
}

TEST_CASE("particles bring the spectrum of a smooth field to the grid: 91 % of the energy at waves of 4 spacings") {
  const double side = 2 * pi;
  const int across = 24;
  const Spectrum wanted = kolmogorov_spectrum(side, across / 4, 1);
  const RandomField field(wanted, 11);
  const Cloud cloud(across, side, [&](Vec3d x) { return field.at(x); });
  const Spectrum found = energy_spectrum(cloud.on_grid(2 * across, side));
  const auto arrived = [&](std::size_t n) { return found.energy[n] / wanted.energy[n]; };
  for (std::size_t n = 1; n <= 2; ++n) CHECK(arrived(n) == Approx(1).margin(0.005));
  CHECK(arrived(3) == Approx(0.99).margin(0.01));
  CHECK(arrived(4) == Approx(0.98).margin(0.01));
  CHECK(arrived(6) == Approx(0.91).margin(0.02));
  const double beyond = std::accumulate(found.energy.begin() + across / 4 + 1, found.energy.end(), 0.0);
  CHECK(beyond < 4e-3);
}

TEST_CASE("a cube that is too narrow, or has a hole, is refused") {
  const auto still = [](Vec3d) { return Vec3d{}; };
  CHECK_THROWS_AS(Cloud(5, 1, still).on_grid(8, 1), InputError);
  Cloud cloud(8, 1, still);
  cloud.position.resize(256);
  cloud.velocity.resize(256);
  CHECK_THROWS_AS(cloud.on_grid(8, 1), InputError);
}
