// Wavelet noise, its curl and the turbulence of its octaves: the statistics, spectra and identities that the papers
// promise, and the same bits everywhere.
#include <omp.h>

#include <Eigen/Dense>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <unsupported/Eigen/FFT>

#include "sim/core/error.h"
#include "sim/turbulence/wavelet_noise.h"

using namespace curlew;

namespace {

const WaveletNoise& noise() {
  static const WaveletNoise made(32, 1);
  return made;
}

// Multiples of 1/128, so that their sums with whole numbers are exact.
const std::vector<Vec3d> offsets{
    {0.1328125, 7.2109375, -3.7734375}, {-11.8984375, 2.578125, 5.0078125}, {4.453125, -8.359375, 1.6796875}};

// Random places in a cube of this width around zero, multiples of 2^-20 so that sums with whole numbers are exact.
std::vector<Vec3d> places(std::size_t number, double width) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(-width / 2, width / 2);
  const auto one = [&] { return std::round(along(random) * 0x1p20) * 0x1p-20; };
  std::vector<Vec3d> found(number);
  for (Vec3d& p : found) p = {one(), one(), one()};
  return found;
}

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// f(coefficients of the three tiles), for all of them.
void for_coefficients(const WaveletNoise& of, const std::function<void(Vec3)>& f) {
  for (int z = 0; z < of.size(); ++z) {
    for (int y = 0; y < of.size(); ++y) {
      for (int x = 0; x < of.size(); ++x) f(of.coefficient(x, y, z));
    }
  }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double aa = 0, ab = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += a[i] * a[i];
    ab += a[i] * b[i];
    bb += b[i] * b[i];
  }
  return ab / std::sqrt(aa * bb);
}

std::vector<double> tile(const WaveletNoise& of, int part) {
  std::vector<double> numbers;
  for_coefficients(of, [&](Vec3 c) { numbers.push_back(double{c[part]}); });
  return numbers;
}

// FNV-1a of the bits of all coefficients.
std::uint64_t hash(const WaveletNoise& of) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for_coefficients(of, [&](Vec3 c) {
    for (int part = 0; part < 3; ++part) {
      const auto bits = std::bit_cast<std::uint32_t>(c[part]);
      for (int byte = 0; byte < 32; byte += 8) h = (h ^ (bits >> byte & 0xff)) * 0x100000001b3u;
    }
  });
  return h;
}

// The quadratic B-spline around 0 (order 0) and its first derivative.
double spline(double u, int order) {
  const double far = 1.5 - std::abs(u);
  if (std::abs(u) <= 0.5) return order == 0 ? 0.75 - u * u : -2 * u;
  if (far < 0) return 0;
  return order == 0 ? 0.5 * far * far : u > 0 ? -far : far;
}

// N of one tile at p, differentiated along `axis` (none if -1), straight from the definition.
double reference(const WaveletNoise& of, Vec3d p, int part, int axis) {
  const int n = of.size();
  const auto inside = [&](double k) { return static_cast<int>(k - n * std::floor(k / n)); };
  double sum = 0;
  for (double z = std::floor(p.z) - 1; z < p.z + 2; ++z) {
    for (double y = std::floor(p.y) - 1; y < p.y + 2; ++y) {
      for (double x = std::floor(p.x) - 1; x < p.x + 2; ++x) {
        sum += spline(p.x - x, axis == 0) * spline(p.y - y, axis == 1) * spline(p.z - z, axis == 2) *
               double{of.coefficient(inside(x), inside(y), inside(z))[part]};
      }
    }
  }
  return sum;
}

// Whether p and all that is nearer to it than `step` along each axis lies in one cell of the splines of each octave.
bool within_cells(Vec3d p, double step, const std::vector<Vec3d>& offset) {
  double scale = 1;
  for (const Vec3d& o : offset) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = scale * p[axis] + o[axis];
      if (std::abs(x - std::round(x)) + scale * step > 0.5) return false;
    }
    scale *= 2;
  }
  return true;
}

using Derivatives = std::array<Vec3d, 3>;  // along x, y, z

// Central differences. Along one axis the noise and its curl are piecewise quadratic: within a cell of the splines they
// are exact with any step, so that a large one keeps what float rounds off small.
Derivatives differences(const std::function<Vec3(Vec3d)>& f, Vec3d p, double step) {
  Derivatives d;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d low = p, high = p;
    low[axis] -= step;
    high[axis] += step;
    d[axis] = 0.5 / step * (to_double(f(high)) - to_double(f(low)));
  }
  return d;
}

// A field of complex numbers on n^3 points, replaced by its Fourier coefficients.
struct Spectrum {
  int n;
  std::vector<std::complex<float>> at;

  explicit Spectrum(int points) : n(points), at(static_cast<std::size_t>(points * points * points)) {}
  std::complex<float>& operator()(int x, int y, int z) { return at[static_cast<std::size_t>(x + n * (y + n * z))]; }

  void transform() {
    Eigen::FFT<float> fft;
    std::vector<std::complex<float>> line(static_cast<std::size_t>(n)), turned(line);
    for (int axis = 0; axis < 3; ++axis) {
      for (int u = 0; u < n * n; ++u) {
        const auto point = [&](int k) -> std::complex<float>& {
          const int i = u % n, j = u / n;
          return axis == 0 ? (*this)(k, i, j) : axis == 1 ? (*this)(i, k, j) : (*this)(i, j, k);
        };
        for (int k = 0; k < n; ++k) line[static_cast<std::size_t>(k)] = point(k);
        fft.fwd(turned, line);
        for (int k = 0; k < n; ++k) point(k) = turned[static_cast<std::size_t>(k)] / static_cast<float>(n);
      }
    }
  }
  // The wavenumber of coefficient k, from -1/2 to 1/2 of a wave a point.
  double wave(int k) const { return static_cast<double>(k < n / 2 ? k : k - n) / n; }

  // f(wavenumbers, energy) for all coefficients.
  template <class F>
  void for_waves(F&& f) {
    for (int z = 0; z < n; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) f(Vec3d{wave(x), wave(y), wave(z)}, double{std::norm((*this)(x, y, z))});
      }
    }
  }
};

double largest(Vec3d k) { return std::max({std::abs(k.x), std::abs(k.y), std::abs(k.z)}); }

// Of the spline around a number: (sin(pi k) / (pi k))^6.
double spline_energy(double k) {
  const double x = std::numbers::pi * k;
  return k == 0 ? 1 : std::pow(std::sin(x) / x, 6);
}

}  // namespace

TEST_CASE("refining and then analysing gives back what one had, and the filters keep a constant") {
  // Fine coefficient f takes refinement[f - 2 i + 2] of coarse coefficient i.
  for (int i = -12; i <= 12; ++i) {
    double sum = 0;
    for (int k = -16; k < 16; ++k) {
      const int q = k + 2 * i + 2;
      if (q >= 0 && q < 4) sum += wavelet_analysis[static_cast<std::size_t>(k + 16)] * wavelet_refinement[q];
    }
    CHECK(sum == Approx(i == 0 ? 1 : 0).margin(3e-4));  // the paper cut the filter off after 32 numbers
  }
  double even = 0, odd = 0;
  for (std::size_t k = 0; k < 32; k += 2) {
    even += wavelet_analysis[k];
    odd += wavelet_analysis[k + 1];
  }
  CHECK(even == Approx(0.5).margin(2e-6));
  CHECK(odd == Approx(0.5).margin(2e-6));
  CHECK(wavelet_refinement[0] + wavelet_refinement[2] == 1);
  CHECK(wavelet_refinement[1] + wavelet_refinement[3] == 1);
}

TEST_CASE("noise has no mean, and the variance of Cook and DeRose") {
  for (const int size : {32, 64}) {
    const WaveletNoise of(size, 2);
    Vec3d mean;
    for_coefficients(of, [&](Vec3 c) { mean += 1 / std::pow(size, 3) * to_double(c); });
    Vec3d value2, curl2;
    const std::size_t number = 100000;
    for (const Vec3d& p : places(number, 10.0 * size)) {
      const Vec3d v = to_double(of.value(p)), w = to_double(of.curl(p));
      value2 += 1.0 / number * Vec3d{v.x * v.x, v.y * v.y, v.z * v.z};
      curl2 += 1.0 / number * Vec3d{w.x * w.x, w.y * w.y, w.z * w.z};
    }
    for (int part = 0; part < 3; ++part) {
      CAPTURE(size, part);
      CHECK(std::abs(mean[part]) < 1e-6);
      CHECK(value2[part] == Approx(wavelet_noise_variance).epsilon(0.04));
      CHECK(curl2[part] == Approx(wavelet_curl_variance).epsilon(0.04));
    }
  }
}

TEST_CASE("noise is as loud on coarse nodes as between them") {
  // One tile alone has variances of 0.081 and 0.031 there; so has a sum of two that are moved by an even number.
  double even = 0, odd = 0;
  const WaveletNoise of(64, 3);
  for (int z = 0; z < 64; z += 2) {
    for (int y = 0; y < 64; y += 2) {
      for (int x = 0; x < 64; x += 2) {
        const Vec3 a = of.value({x + 0.5, y + 0.5, z + 0.5}), b = of.value({x + 1.5, y + 1.5, z + 1.5});
        even += double{dot(a, a)} / (3 * 32 * 32 * 32);
        odd += double{dot(b, b)} / (3 * 32 * 32 * 32);
      }
    }
  }
  CHECK(even == Approx(0.1112).epsilon(0.05));
  CHECK(odd == Approx(0.1112).epsilon(0.05));
}

TEST_CASE("a tile holds one octave of waves") {
  Spectrum spectrum(32);
  std::array<double, 4> shell{};  // largest wavenumber below 1/8, 1/4, 1/2 of a wave a cell, and above
  for (int part = 0; part < 3; ++part) {
    for (int z = 0; z < 32; ++z) {
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) spectrum(x, y, z) = noise().coefficient(x, y, z)[part];
      }
    }
    spectrum.transform();
    spectrum.for_waves([&](Vec3d k, double energy) {
      double below = energy, all = energy;
      for (int axis = 0; axis < 3; ++axis) {
        double images = 0;  // a wave of the coefficients is many of the splines' sum
        for (int image = -4; image <= 4; ++image) images += spline_energy(k[axis] + image);
        below *= spline_energy(k[axis]);
        all *= images;
      }
      const double l = largest(k);
      shell[l < 0.125 ? 0 : l < 0.25 ? 1 : 2] += below;
      shell[3] += all - below;
    });
  }
  const double sum = shell[0] + shell[1] + shell[2] + shell[3];
  CHECK(sum == Approx(3 * wavelet_noise_variance).epsilon(0.04));
  CHECK(shell[0] < 2e-4 * sum);
  CHECK(shell[1] < 0.15 * sum);
  CHECK(shell[2] > 0.78 * sum);
  CHECK(shell[3] < 0.1 * sum);
}

TEST_CASE("down-sampling leaves little of a tile") {
  // Nothing (7e-8) of the half of the noise whose coarse grid is the filter's own; of the other half, moved by one
  // cell, waves near four cells remain, which the splines do not separate sharply. Another octave down they are gone.
  std::vector<double> numbers = tile(noise(), 0);
  const auto energy = [&] {
    double sum = 0;
    for (const double v : numbers) sum += v * v;
    return sum;
  };
  const double all = energy();
  std::array<int, 3> n{32, 32, 32};
  const auto halve = [&](int axis) {
    std::array<int, 3> half = n;
    half[axis] /= 2;
    std::vector<double> to;
    for (int z = 0; z < half[2]; ++z) {
      for (int y = 0; y < half[1]; ++y) {
        for (int x = 0; x < half[0]; ++x) {
          double sum = 0;
          for (int k = -16; k < 16; ++k) {
            std::array<int, 3> at{x, y, z};
            at[axis] = (2 * at[axis] + k + n[axis]) % n[axis];
            sum += wavelet_analysis[static_cast<std::size_t>(k + 16)] * numbers[at[0] + n[0] * (at[1] + n[1] * at[2])];
          }
          to.push_back(sum);
        }
      }
    }
    numbers = to;
    n = half;
  };
  for (int axis = 0; axis < 3; ++axis) halve(axis);
  CHECK(energy() < 0.05 * all);
  for (int axis = 0; axis < 3; ++axis) halve(axis);
  CHECK(energy() < 1e-3 * all);
}

TEST_CASE("value and curl are those of quadratic B-splines around the numbers") {
  for (const Vec3d& p : places(300, 200)) {
    const auto d = [&](int part, int axis) { return reference(noise(), p, part, axis); };
    const Vec3d value = to_double(noise().value(p)), curl = to_double(noise().curl(p));
    CHECK(length(value - Vec3d{d(0, -1), d(1, -1), d(2, -1)}) < 2e-6);
    CHECK(length(curl - Vec3d{d(2, 1) - d(1, 2), d(0, 2) - d(2, 0), d(1, 0) - d(0, 1)}) < 5e-6);
  }
}

TEST_CASE("the curl agrees with central differences of the noise") {
  int checked = 0;
  for (const Vec3d& p : places(2000, 100)) {
    if (!within_cells(p, 0.1, {{}})) continue;
    const Derivatives d = differences([](Vec3d q) { return noise().value(q); }, p, 0.1);
    const Vec3d curl{d[1].z - d[2].y, d[2].x - d[0].z, d[0].y - d[1].x};
    CHECK(length(curl - to_double(noise().curl(p))) < 1e-5);
    ++checked;
  }
  CHECK(checked > 500);
}

TEST_CASE("turbulence has no divergence") {
  const auto y = [](Vec3d p) { return noise().turbulence(p, offsets); };
  double divergence2 = 0, gradient2 = 0, largest_divergence = 0;
  int checked = 0;
  for (const Vec3d& p : places(20000, 100)) {
    if (!within_cells(p, 0.04, offsets)) continue;
    const Derivatives d = differences(y, p, 0.04);
    const double divergence = d[0].x + d[1].y + d[2].z;
    largest_divergence = std::max(largest_divergence, std::abs(divergence));
    divergence2 += divergence * divergence;
    for (const Vec3d& along : d) gradient2 += dot(along, along);
    ++checked;
  }
  CHECK(checked > 1000);
  CHECK(std::sqrt(divergence2 / gradient2) < 1e-6);
  CHECK(largest_divergence < 1e-5 * std::sqrt(gradient2 / checked));
}

TEST_CASE("turbulence is the sum of the curls of its octaves") {
  for (const Vec3d& p : places(300, 100)) {
    Vec3d sum;
    for (std::size_t o = 0; o < offsets.size(); ++o) {
      const double scale = std::pow(2, o);
      sum += std::pow(2, -5.0 / 6 * static_cast<double>(o)) * to_double(noise().curl(scale * p + offsets[o]));
    }
    CHECK(length(to_double(noise().turbulence(p, offsets)) - sum) < 2e-6);
    CHECK(same(noise().turbulence(p, {}), {}));
  }
}

TEST_CASE("the energy of the octaves falls by 2^(-5/3)") {
  std::vector<Vec3d> four = offsets;
  four.push_back({2.3, 9.6, -0.9});
  std::array<double, 4> energy{};
  for (const Vec3d& p : places(100000, 32)) {
    Vec3d sum;
    for (std::size_t o = 0; o < 4; ++o) {
      const Vec3d with = to_double(noise().turbulence(p, {four.data(), o + 1}));
      const Vec3d alone = with - sum;
      energy[o] += dot(alone, alone);
      sum = with;
    }
  }
  for (std::size_t o = 0; o < 3; ++o) CHECK(energy[o + 1] / energy[o] == Approx(std::pow(2, -5.0 / 3)).epsilon(0.05));
}

// Mean energy of f along random lines of one period, where the wavenumber along the line, in waves a cell, is in
// (1/32, 1/16], (1/16, 1/8], and so on to (2, 4].
std::array<double, 7> line_spectrum(const std::function<Vec3(Vec3d)>& f) {
  constexpr int points = 256, lines = 1500;
  std::array<double, 7> energy{};
  Eigen::FFT<double> fft;
  std::array<std::vector<double>, 3> field;
  std::vector<std::complex<double>> waves;
  for (const Vec3d& start : places(lines, 64)) {
    for (auto& part : field) part.clear();
    for (int k = 0; k < points; ++k) {
      const Vec3d y = to_double(f(start + Vec3d{32.0 / points * k, 0, 0}));
      for (std::size_t part = 0; part < 3; ++part) field[part].push_back(y[static_cast<int>(part)]);
    }
    for (const auto& part : field) {
      fft.fwd(waves, part);
      for (std::size_t m = 2; m <= points / 2; ++m)
        energy[static_cast<std::size_t>(std::ceil(std::log2(m))) - 1] += std::norm(waves[m] / double{points}) / lines;
    }
  }
  return energy;
}

TEST_CASE("so it does in the Fourier transform of turbulence along lines") {
  // The bands of octaves overlap, more so along a line. How much of one octave lies in which band is taken from the
  // coarsest alone; then three bands of the sum of three octaves tell the energy of each.
  const auto one = line_spectrum([](Vec3d p) { return noise().curl(p + offsets[0]); });
  const auto sum = line_spectrum([](Vec3d p) { return noise().turbulence(p, offsets); });
  Eigen::Matrix3d share;
  Eigen::Vector3d band;
  for (std::size_t b = 0; b < 3; ++b) {
    band[b] = sum[b + 3];
    for (std::size_t octave = 0; octave < 3; ++octave) share(b, octave) = one[b + 3 - octave];
  }
  const Eigen::Vector3d energy = share.inverse() * band;
  CHECK(energy[0] == Approx(1).epsilon(0.03));
  CHECK(energy[1] / energy[0] == Approx(std::pow(2, -5.0 / 3)).epsilon(0.05));
  CHECK(energy[2] / energy[1] == Approx(std::pow(2, -5.0 / 3)).epsilon(0.05));
}

TEST_CASE("noise repeats itself after its size, and nowhere before") {
  for (const Vec3d& p : places(300, 40)) {
    for (const Vec3d& periods :
         {Vec3d{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {-2, 3, -5}, {-313, 313, 400}, {1e6, -1e6, 3e6}}) {
      const Vec3d q = p + 32.0 * periods;
      REQUIRE(same(noise().value(p), noise().value(q)));
      REQUIRE(same(noise().turbulence(p, offsets), noise().turbulence(q, offsets)));
    }
  }
  for (int part = 0; part < 3; ++part) {
    for (int moved = 8; moved <= 24; ++moved) {
      std::vector<double> here, there;
      for (int z = 0; z < 32; ++z) {
        for (int y = 0; y < 32; ++y) {
          for (int x = 0; x < 32; ++x) {
            const auto in = [&](int k) { return (k + moved) % 32; };
            here.push_back(double{noise().coefficient(x, y, z)[part]});
            there.push_back(double{noise().coefficient(in(x), in(y), in(z))[part]});
          }
        }
      }
      CHECK(std::abs(correlation(here, there)) < 0.03);
    }
  }
}

TEST_CASE("what is not finite gives NaN and reads no foreign memory") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    for (const Vec3d& p : {Vec3d{bad, 0, 0}, {0, bad, 0}, {0, 0, bad}}) {
      CHECK(std::isnan(noise().value(p).x));
      CHECK(std::isnan(noise().turbulence(p, offsets).y));
    }
  }
  for (const double far : {1e15, -1e18, 1e300}) CHECK_NOTHROW(noise().turbulence({far, -far, far}, offsets));
}

TEST_CASE("the three tiles know nothing of each other, nor of those of another seed") {
  const WaveletNoise other(32, 2);
  for (int part = 0; part < 3; ++part) {
    const std::vector<double> here = tile(noise(), part);
    CHECK(std::abs(correlation(here, tile(noise(), (part + 1) % 3))) < 0.02);
    for (int another = 0; another < 3; ++another) CHECK(std::abs(correlation(here, tile(other, another))) < 0.02);
  }
}

TEST_CASE("a seed gives the same bits on any number of threads, and with any compiler") {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    CHECK(hash(WaveletNoise(32, 1)) == 0x1542406e3aeaa002u);
    CHECK(hash(WaveletNoise(64, 0xfedcba9876543210u)) == 0xe70c54422db1678bu);
  }
  omp_set_num_threads(before);
  CHECK(hash(WaveletNoise(32, 2)) != hash(noise()));
}

TEST_CASE("a tile of wavelet noise has a size that its filters can halve, and says what it takes") {
  for (const int size : {-32, 0, 16, 33, 48, 96, 512}) {
    CHECK_THROWS_WITH(WaveletNoise(size, 1),
                      "a tile of wavelet noise has 32, 64, 128 or 256 numbers along each axis, "
                      "not " +
                          std::to_string(size));
    CHECK_THROWS_AS(WaveletNoise(size, 1), InputError);
  }
  CHECK(WaveletNoise().empty());
  CHECK(WaveletNoise().bytes() == 0);
  CHECK(noise().size() == 32);
  CHECK(noise().bytes() == 34 * 34 * 34 * 16);
}
