// Flows with a free surface and an exact answer, or a measured one: what the work-precision cases compare with, and
// how.
#pragma once

#include <span>
#include <vector>

#include "sim/core/world.h"

namespace curlew {

// A signal that swings about zero, sampled step by step.
class Oscillation {
 public:
  void add(double time, double value);

  // From the times at which it passes zero, least squares (s). Needs two of them.
  double period() const;
  // Share of the amplitude lost in a period, from the peaks between those times, least squares of their logarithms.
  // Needs two of them.
  double loss_per_period() const;

 private:
  double last_time_ = 0, last_ = 0, peak_ = 0, highest_ = 0;
  bool begun_ = false;
  std::vector<double> zeros_, peaks_;  // a peak belongs between two zeros
};

// Standing wave between free surface and floor: omega^2 = g k tanh(k h), less (k A)^2 / 8 of itself in deep water
// (Rayleigh 1915), period in s; depth and amplitude in m.
double standing_wave_period(double gravity, double wave_number, double depth, double amplitude);

// Pressure p / (rho omega^2 L^2) in a square [0, 1]^2 of fluid that turns like a rigid body, at the moment when it is
// set free (Colagrossi 2005; Le Touze et al. 2013, doi:10.1002/fld.3819): the solution of lap p = 2 rho omega^2, p = 0
// on the rim. Negative all over.
double square_patch_pressure(double x, double y);

// Area (m^2) in which the SPH density of the particles is at least half the rest density: half a spacing around a
// straight rim of particles, voids narrower than a spacing filled, single particles left out. 2D.
double covered_area(const World& world);

// An elliptic drop under the central force -Omega^2 x (Monaghan & Rafiee 2013, doi:10.1002/fld.3671): u = (sigma x,
// -sigma y), semi-axes a and b.
struct EllipticDrop {
  double a = 1, b = 1;  // m
  double sigma = 1;     // 1/s

  // da/dt = sigma a, db/dt = -sigma b, dsigma/dt = (sigma^2 + Omega^2) (b^2 - a^2) / (a^2 + b^2), Runge-Kutta of fourth
  // order in steps of at most 1 ms.
  void advance(double dt, double force);
};
// Until it is round and swells along x again (s).
double elliptic_drop_period(EllipticDrop start, double force);

// How far a surge front had come: time t sqrt(2 g / a), place z / a, with a the width of the column.
struct FrontPoint {
  double time = 0, place = 0;
};
struct FrontSeries {
  const char* name;
  std::span<const FrontPoint> points;
};
// Columns twice as high as wide that fall on a dry floor, as measured.
std::span<const FrontSeries> measured_fronts();

// How far a front lies from a measured one after the shift in time that suits it best: no experiment knows when its
// gate was open. `curve` is linear between its points.
struct FrontDistance {
  double shift = 0;  // added to the measured times
  double sum2 = 0;   // of squared distances z / a
  std::vector<double> distances;
};
FrontDistance front_distance(std::span<const FrontPoint> curve, std::span<const FrontPoint> measured);

// Root mean square distance z / a of the measured series from each other.
double front_scatter();

}  // namespace curlew
