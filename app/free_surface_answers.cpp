// References:
//   Colagrossi 2005, "A meshless Lagrangian method for free-surface and interface flows with fragmentation", PhD
//   thesis,
//     Rome: the square patch.
//   Koshizuka & Oka 1996, "Moving-particle semi-implicit method for fragmentation of incompressible fluid", Nuclear
//     Science and Engineering 123, doi:10.13182/NSE96-A24205.
//   Martin & Moyce 1952, "An experimental study of the collapse of liquid columns on a rigid horizontal plane", Phil.
//     Trans. R. Soc. A 244, doi:10.1098/rsta.1952.0006.
//   Monaghan & Rafiee 2013, "A simple SPH algorithm for multi-fluid flow with high density ratios", Int. J. Numer.
//   Meth.
//     Fluids 71: the drop.
//   Rayleigh 1915, "Deep water waves, progressive or stationary, to the third order of approximation", Proc. R. Soc. A
//     91: the standing wave's period.
#include "app/free_surface_answers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace curlew {
namespace {

constexpr double pi = std::numbers::pi;

double square(double x) { return x * x; }

// Slope of the least-squares line through (0, y[0]), (1, y[1]), ...
double slope_of(const std::vector<double>& y) {
  const double n = static_cast<double>(y.size()), middle = (n - 1) / 2;
  double sxy = 0, sxx = 0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double x = static_cast<double>(k) - middle;
    sxy += x * y[k], sxx += x * x;
  }
  return sxy / sxx;
}

double interpolated(std::span<const FrontPoint> curve, double time) {
  const auto after = std::lower_bound(curve.begin() + 1, curve.end() - 1, time,
                                      [](const FrontPoint& p, double t) { return p.time < t; });
  const FrontPoint a = after[-1], b = *after;
  return a.place + (b.place - a.place) * (time - a.time) / (b.time - a.time);
}

constexpr FrontPoint martin_moyce_1125[] = {{0.849, 1.245}, {1.212, 1.443}, {1.602, 1.884}, {2.283, 2.689},
                                            {2.95, 3.728},  {3.598, 4.528}, {3.905, 4.999}, {4.592, 5.841},
                                            {4.961, 6.271}, {5.316, 6.717}};
constexpr FrontPoint martin_moyce_225[] = {{0.832, 1.217}, {1.219, 1.474}, {1.997, 2.292}, {2.547, 2.995},
                                           {3.345, 4.134}, {4.034, 4.944}, {4.418, 5.881}, {5.091, 6.98}};
constexpr FrontPoint koshizuka_oka[] = {{0, 1},         {0.381, 1.111}, {0.769, 1.252}, {1.153, 1.505}, {1.537, 1.892},
                                        {1.935, 2.241}, {2.323, 2.615}, {2.719, 3.003}, {3.096, 3.624}};

}  // namespace

void Oscillation::add(double time, double value) {
  // A tenth of the highest peak away from zero first: noise at zero is no swing.
  if (begun_ && last_ * value < 0 && peak_ > 0.1 * highest_) {
    if (!zeros_.empty()) peaks_.push_back(peak_);
    zeros_.push_back(last_time_ + (time - last_time_) * last_ / (last_ - value));
    peak_ = 0;
  }
  peak_ = std::max(peak_, std::abs(value));
  highest_ = std::max(highest_, peak_);
  last_time_ = time, last_ = value, begun_ = true;
}

double Oscillation::period() const { return 2 * slope_of(zeros_); }

double Oscillation::loss_per_period() const {
  std::vector<double> logarithms;
  for (const double peak : peaks_) logarithms.push_back(std::log(peak));
  return 1 - std::exp(2 * slope_of(logarithms));
}

double standing_wave_period(double gravity, double wave_number, double depth, double amplitude) {
  const double linear = std::sqrt(gravity * wave_number * std::tanh(wave_number * depth));
  return 2 * pi / (linear * (1 - square(wave_number * amplitude) / 8));
}

double square_patch_pressure(double x, double y) {
  // One of the two sums of the double Fourier series in closed form: p = sum over odd m of
  // -8 / (m pi)^3 (1 - cosh(m pi (y - 1/2)) / cosh(m pi / 2)) sin(m pi x).
  double p = 0;
  for (int m = 1; m < 60; m += 2) {
    const double k = m * pi;
    p -= 8 / (k * k * k) * (1 - std::cosh(k * (y - 0.5)) / std::cosh(k / 2)) * std::sin(k * x);
  }
  return p;
}

double covered_area(const World& world) {
  const double pitch = world.scene.spacing() / 4, reach = world.kernel.support();
  std::unordered_map<std::uint64_t, double> number_density;  // per point of a grid
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3d p = to_double(world.fields.position[i]);
    const auto first = [&](double x) { return static_cast<std::int64_t>(std::ceil((x - reach) / pitch - 0.5)); };
    const auto last = [&](double x) { return static_cast<std::int64_t>(std::floor((x + reach) / pitch - 0.5)); };
    for (std::int64_t row = first(p.y); row <= last(p.y); ++row) {
      for (std::int64_t column = first(p.x); column <= last(p.x); ++column) {
        const double x = (static_cast<double>(column) + 0.5) * pitch, y = (static_cast<double>(row) + 0.5) * pitch;
        const auto key = static_cast<std::uint64_t>(row) << 32 ^ (static_cast<std::uint64_t>(column) & 0xffffffff);
        number_density[key] += world.kernel.value(std::hypot(x - p.x, y - p.y));
      }
    }
  }
  const double half = world.parameters().sph.rest_density / double{world.mass} / 2;
  const auto covered = std::count_if(number_density.begin(), number_density.end(),
                                     [&](const auto& point) { return point.second >= half; });
  return static_cast<double>(covered) * pitch * pitch;
}

void EllipticDrop::advance(double dt, double force) {
  const auto rate = [&](const EllipticDrop& d) {
    const double a2 = d.a * d.a, b2 = d.b * d.b;
    return EllipticDrop{d.sigma * d.a, -d.sigma * d.b, (d.sigma * d.sigma + force * force) * (b2 - a2) / (a2 + b2)};
  };
  const auto moved = [&](const EllipticDrop& r, double t) {
    return EllipticDrop{a + t * r.a, b + t * r.b, sigma + t * r.sigma};
  };
  const int parts = std::max(1, static_cast<int>(std::ceil(dt / 1e-3)));
  const double t = dt / parts;
  for (int part = 0; part < parts; ++part) {
    const EllipticDrop k1 = rate(*this), k2 = rate(moved(k1, t / 2)), k3 = rate(moved(k2, t / 2)),
                       k4 = rate(moved(k3, t));
    a += t / 6 * (k1.a + 2 * k2.a + 2 * k3.a + k4.a);
    b += t / 6 * (k1.b + 2 * k2.b + 2 * k3.b + k4.b);
    sigma += t / 6 * (k1.sigma + 2 * k2.sigma + 2 * k3.sigma + k4.sigma);
  }
}

double elliptic_drop_period(EllipticDrop drop, double force) {
  Oscillation stretching;
  for (int k = 0; k < 20'000; ++k) {
    stretching.add(k * 1e-3 / force, drop.sigma);
    drop.advance(1e-3 / force, force);
  }
  return stretching.period();
}

std::span<const FrontSeries> measured_fronts() {
  static constexpr FrontSeries series[] = {{"Martin & Moyce 1952, fig. 3, a = 1.125 in", martin_moyce_1125},
                                           {"Martin & Moyce 1952, fig. 3, a = 2.25 in", martin_moyce_225},
                                           {"Koshizuka & Oka 1996", koshizuka_oka}};
  return series;
}

FrontDistance front_distance(std::span<const FrontPoint> curve, std::span<const FrontPoint> measured) {
  FrontDistance best;
  best.sum2 = INFINITY;
  double best_mean = INFINITY;
  for (double shift = -1; shift <= 1; shift += 0.005) {
    FrontDistance d{shift, 0, {}};
    for (const FrontPoint& p : measured) {
      const double time = p.time + shift;
      if (time < curve.front().time || time > curve.back().time) continue;
      d.distances.push_back(interpolated(curve, time) - p.place);
      d.sum2 += square(d.distances.back());
    }
    const double mean = d.sum2 / static_cast<double>(d.distances.size());
    if (d.distances.size() + 2 < measured.size() || !(mean < best_mean)) continue;
    best_mean = mean;
    best = std::move(d);
  }
  return best;
}

double front_scatter() {
  double sum2 = 0, n = 0;
  for (const FrontSeries& one : measured_fronts()) {
    for (const FrontSeries& other : measured_fronts()) {
      if (one.name == other.name) continue;
      const FrontDistance d = front_distance(one.points, other.points);
      if (d.distances.empty()) continue;
      sum2 += d.sum2, n += static_cast<double>(d.distances.size());
    }
  }
  return std::sqrt(sum2 / n);
}

}  // namespace curlew
