#include "sim/measure/random_field.h"

#include <cmath>
#include <numbers>

namespace curlew {
namespace {

// Normal numbers (Box & Muller 1958) from splitmix64 (Steele, Lea & Flood 2014).
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : state_(seed) {}
  double next() {
    const double radius = std::sqrt(-2 * std::log(uniform())), angle = 2 * std::numbers::pi * uniform();
    return radius * std::cos(angle);
  }
  Vec3d vector() {
    const double x = next(), y = next();
    return {x, y, next()};
  }

 private:
  double uniform() {  // 0 not included
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 1) * 0x1p-53;
  }
  std::uint64_t state_;
};

std::size_t shell_of(Vec3d k) { return static_cast<std::size_t>(length(k) + 0.5); }

Vec3d across(Vec3d a, Vec3d k) { return a + (-dot(a, k) / dot(k, k)) * k; }

// cos and sin of n phase for n from 0 to last.
struct Harmonics {
  std::vector<double> cosine, sine;
  Harmonics(double phase, int last) {
    for (int n = 0; n <= last; ++n) {
      cosine.push_back(std::cos(n * phase));
      sine.push_back(std::sin(n * phase));
    }
  }
  double cos_of(int n) const { return cosine[static_cast<std::size_t>(std::abs(n))]; }
  double sin_of(int n) const { return n < 0 ? -sine[static_cast<std::size_t>(-n)] : sine[static_cast<std::size_t>(n)]; }
};

}  // namespace

Spectrum kolmogorov_spectrum(double side, int last, double energy) {
  Spectrum spectrum{2 * std::numbers::pi / side, {0}};
  for (int n = 1; n <= last; ++n) spectrum.energy.push_back(std::pow(n, -5.0 / 3));
  const double scale = energy / spectrum.total();
  for (double& e : spectrum.energy) e *= scale;
  return spectrum;
}

RandomField::RandomField(const Spectrum& spectrum, std::uint64_t seed)
    : step_(spectrum.step), last_(static_cast<int>(spectrum.energy.size()) - 1) {
  NormalNumbers normal(seed);
  std::vector<double> drawn(spectrum.energy.size());
  std::vector<std::size_t> shells;
  const auto inside = [&](Vec3d k) { return shell_of(k) < spectrum.energy.size(); };
  for (int x = 0; x <= last_; ++x) {
    for (int y = x == 0 ? 0 : -last_; y <= last_; ++y) {
      int z = x == 0 && y == 0 ? 1 : -last_;
      while (z <= last_ && !inside({1.0 * x, 1.0 * y, 1.0 * z})) ++z;
      Row row{x, y, z, waves_.size(), 0};
      for (; z <= last_ && inside({1.0 * x, 1.0 * y, 1.0 * z}); ++z) {
        const Vec3d k{1.0 * x, 1.0 * y, 1.0 * z};
        Wave wave{across(normal.vector(), k), across(normal.vector(), k)};
        shells.push_back(shell_of(k));
        drawn[shells.back()] += (dot(wave.cosine, wave.cosine) + dot(wave.sine, wave.sine)) / 4;
        waves_.push_back(wave);
      }
      row.end = waves_.size();
      if (row.end > row.begin) rows_.push_back(row);
    }
  }
  for (std::size_t n = 0; n < waves_.size(); ++n) {
    const double scale = std::sqrt(spectrum.energy[shells[n]] * step_ / drawn[shells[n]]);
    waves_[n] = {scale * waves_[n].cosine, scale * waves_[n].sine};
  }
}

Vec3d RandomField::at(Vec3d x) const {
  const Harmonics along_x(step_ * x.x, last_), along_y(step_ * x.y, last_), along_z(step_ * x.z, last_);
  Vec3d sum;
  for (const Row& row : rows_) {
    // sum a exp(i k_z z) = c + i s up to the factor exp(i (k_x x + k_y y)), of which the real part counts.
    Vec3d c, s;
    int z = row.first_z;
    for (std::size_t n = row.begin; n < row.end; ++n, ++z) {
      const double cosine = along_z.cos_of(z), sine = along_z.sin_of(z);
      const Wave& a = waves_[n];
      c += cosine * a.cosine + sine * a.sine;
      s += sine * a.cosine + -cosine * a.sine;
    }
    const double cx = along_x.cos_of(row.x), sx = along_x.sin_of(row.x);
    const double cy = along_y.cos_of(row.y), sy = along_y.sin_of(row.y);
    sum += (cx * cy - sx * sy) * c + -(sx * cy + cx * sy) * s;
  }
  return sum;
}

}  // namespace curlew
