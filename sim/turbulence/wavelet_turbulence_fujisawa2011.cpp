#include "sim/turbulence/wavelet_turbulence_fujisawa2011.h"

#include <cmath>
#include <numbers>

#include "sim/core/error.h"
#include "sim/core/parallel.h"
#include "sim/sph/pair_sums.h"
#include "sim/turbulence/energy_guard.h"

namespace curlew {
namespace {

// |int psi q^2| / int |psi|.
double kappa(int dimension) {
  return dimension == 3 ? std::sqrt(std::numbers::pi / 6) * std::exp(1.5) : std::numbers::e;
}

// The sums of the transform over the neighbours j of a particle i: x and u are those of j less those of i.
struct TransformSums {
  VectorSum difference, moment;           // psi u, psi x
  f8 weight{};                            // |psi| x^2
  VectorSum along_x, along_y, along_z;    // u times g x, g y, g z; g = exp(-q^2 / 2)
  f8 xx{}, yy{}, zz{}, yz{}, zx{}, xy{};  // g x x

  void add(const Pairs& p, Vec3 here, const Vec8& there, float dimension, float inverse_s2) {
    const f8 q2 = inverse_s2 * p.r2, g = exponential(-0.5f * q2), psi = (dimension - q2) * g;
    const f8 ux = there.x - here.x, uy = there.y - here.y, uz = there.z - here.z;
    const f8 x = -p.x, y = -p.y, z = -p.z, gx = g * x, gy = g * y, gz = g * z;
    difference.add(psi * ux, psi * uy, psi * uz);
    moment.add(psi * x, psi * y, psi * z);
    weight += max(psi, -psi) * p.r2;
    along_x.add(gx * ux, gx * uy, gx * uz);
    along_y.add(gy * ux, gy * uy, gy * uz);
    along_z.add(gz * ux, gz * uy, gz * uz);
    xx += gx * x, yy += gy * y, zz += gz * z;
    yz += gy * z, zx += gz * x, xy += gx * y;
  }

  // M^-1 m, with M the moments of g and m that of psi: sum psi u - G m, with G = sum g u x^T M^-1, is then
  // sum psi u - sum g u (x . M^-1 m).
  Vec3 linear_weights() const {
    const double a0 = sum(xx), b0 = sum(yy), c0 = sum(zz), d = sum(yz), e = sum(zx), f = sum(xy);
    // A little of the unit matrix, for neighbours that lie in a plane or on a line.
    const double little = 1e-6 * (a0 + b0 + c0), a = a0 + little, b = b0 + little, c = c0 + little;
    const double determinant = a * (b * c - d * d) - f * (f * c - d * e) + e * (f * d - b * e);
    if (!(determinant > 0)) return {};
    const Vec3d m = to_double(moment.total());
    return to_float((1 / determinant) * Vec3d{(b * c - d * d) * m.x + (d * e - f * c) * m.y + (f * d - b * e) * m.z,
                                              (d * e - f * c) * m.x + (a * c - e * e) * m.y + (f * e - a * d) * m.z,
                                              (f * d - b * e) * m.x + (f * e - a * d) * m.y + (a * b - f * f) * m.z});
  }

  // sum psi u without its linear part, over the sum of |psi| x^2; m/s over m^2.
  Vec3 transform() const {
    const float weights = sum(weight);
    if (!(weights > 0)) return {};
    const Vec3 k = linear_weights();
    return (1 / weights) * (difference.total() - k.x * along_x.total() - k.y * along_y.total() - k.z * along_z.total());
  }
};

}  // namespace

void find_wavelet_energy(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const double s = world.parameters().wavelet.scale * world.scene.spacing();
  const auto inverse_s2 = static_cast<float>(1 / (s * s));
  const auto factor = static_cast<float>(kappa(world.scene.dimension) * s * s);
  const auto dimension = static_cast<float>(world.scene.dimension);
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      const Vec3 here = f.velocity[i];
      TransformSums sums;
      for_pairs(world.neighbours, f.position.data(), i, images,
                [&](const Pairs& p) { sums.add(p, here, gather(f.velocity.data(), p.j), dimension, inverse_s2); });
      const Vec3 u = factor * sums.transform();
      f.wavelet_energy[i] = 0.5f * dot(u, u);
    });
  });
}

TurbulenceField::TurbulenceField(const WaveletNoise& noise, double finest, int octaves, double moved, int dimension)
    : noise_(&noise),
      cells_per_metre_(1 / std::ldexp(finest, octaves - 1)),
      octaves_(static_cast<std::size_t>(octaves)),
      flat_(dimension == 2) {
  // Each octave has its place in the tile and a direction in which it moves, a golden angle from the one before. Its
  // eddies turn over faster than the coarser ones': times go with l^(2/3).
  for (std::size_t o = 0; o < octaves_; ++o) {
    const auto k = static_cast<double>(o);
    const double angle = 2.399963 * (k + 1), up = flat_ ? 0 : 0.8 * std::cos(1.7 * k + 0.4);
    const double along = std::sqrt(1 - up * up), way = moved * std::exp2(2.0 / 3 * k);
    offset_[o] = Vec3d{7.3 + 11.7 * k, 23.9 + 5.3 * k, 14.1 + 17.9 * k} +
                 way * Vec3d{along * std::cos(angle), along * std::sin(angle), up};
  }
}

Vec3 TurbulenceField::at(Vec3 x) const {
  const Vec3d p = cells_per_metre_ * to_double(x);
  const std::span<const Vec3d> offset(offset_.data(), octaves_);
  return flat_ ? noise_->planar_turbulence(p, offset) : noise_->turbulence(p, offset);
}

std::shared_ptr<const WaveletNoise> make_wavelet_noise(const WaveletParameters& parameters, std::uint64_t seed) {
  const int tile = parameters.tile;
  if (tile != 32 && tile != 64 && tile != 128 && tile != 256) {
    throw InputError("wavelet.tile is " + std::to_string(tile) + ", expected 32, 64, 128 or 256");
  }
  return std::make_shared<const WaveletNoise>(tile, seed);
}

void add_wavelet_turbulence(World& world) {
  using enum WaveletParameters::form_t;
  Fields& f = world.fields;
  const WaveletParameters& p = world.parameters().wavelet;
  const double tau = p.form == rate ? p.reference_step : world.dt;
  const auto strength = static_cast<float>(p.amplitude / tau), threshold = static_cast<float>(p.threshold);
  const TurbulenceField field(*world.wavelet.noise, world.scene.spacing(), p.octaves, world.wavelet.moved,
                              world.scene.dimension);
  struct Acting {
    double energy = 0, number = 0;
    void operator+=(const Acting& other) {
      energy += other.energy;
      number += other.number;
    }
  };
  const Acting acting = ordered_sum<Acting>(world.count, [&](std::size_t begin, std::size_t end) {
    Acting sum;
    for (std::size_t i = begin; i < end; ++i) {
      const float energy = f.wavelet_energy[i] - threshold;
      if (!(energy > 0)) continue;
      push(f, i, strength * energy * field.at(f.position[i]));
      sum += {double{energy}, 1};
    }
    return sum;
  });
  world.wavelet.mean_energy = acting.number > 0 ? acting.energy / acting.number : 0;
}

void drift_wavelet_noise(World& world) {
  const WaveletParameters& p = world.parameters().wavelet;
  const double cell = std::ldexp(world.scene.spacing(), p.octaves - 1);
  world.wavelet.moved += p.renewal * std::sqrt(2 * world.wavelet.mean_energy) * world.dt / cell;
}

}  // namespace curlew
