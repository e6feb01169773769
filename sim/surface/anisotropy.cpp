#include "sim/surface/anisotropy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "sim/core/parallel.h"
#include "sim/core/simd.h"
#include "sim/sph/candidates.h"

namespace curlew {
namespace {

constexpr double neighbourhood = 3;  // spacings
constexpr float fewest = 16;         // neighbours: below, a source stays round (Yu & Turk 2013, section 4)
constexpr double flattest = 0.25;    // shortest axis over longest, likewise

// Sums over the neighbours within `radius`, each with the weight 1 - (r / radius)^2.
struct Surroundings {
  float number = 0, weight = 0;
  Vec3 mean;             // m, from here
  Vec3 diagonal, mixed;  // m^2: xx, yy, zz and yz, zx, xy of the covariance about the mean
};

Surroundings surroundings(const Candidates& near, Vec3 here, float radius) {
  f8 number{}, weight{}, x{}, y{}, z{}, xx{}, yy{}, zz{}, yz{}, zx{}, xy{};
  for (std::size_t k = 0; k < near.size; k += 8) {
    const Candidates::Offsets o = near.offsets(here, k);
    const f8 w = max(1.0f - o.r2 * (1 / (radius * radius)), f8{});
    number += w > 0.0f ? splat(1.0f) : f8{};
    weight += w;
    const f8 wx = w * o.x, wy = w * o.y, wz = w * o.z;
    x -= wx, y -= wy, z -= wz;  // offsets point here
    xx += wx * o.x, yy += wy * o.y, zz += wz * o.z;
    yz += wy * o.z, zx += wz * o.x, xy += wx * o.y;
  }
  Surroundings s;
  s.number = sum(number);
  s.weight = sum(weight);
  const float share = 1 / s.weight;
  s.mean = share * Vec3{sum(x), sum(y), sum(z)};
  s.diagonal =
      share * Vec3{sum(xx), sum(yy), sum(zz)} - Vec3{s.mean.x * s.mean.x, s.mean.y * s.mean.y, s.mean.z * s.mean.z};
  s.mixed =
      share * Vec3{sum(yz), sum(zx), sum(xy)} - Vec3{s.mean.y * s.mean.z, s.mean.z * s.mean.x, s.mean.x * s.mean.y};
  return s;
}

// The shape with the longest axis of `radius`, and by what its volume is smaller than that of a ball.
struct Flattened {
  SourceShape shape;
  float share = 1;
};

Flattened flattened(const Surroundings& s, double radius) {
  Eigen::Matrix3d covariance;
  covariance << s.diagonal.x, s.mixed.z, s.mixed.y,  //
      s.mixed.z, s.diagonal.y, s.mixed.x,            //
      s.mixed.y, s.mixed.x, s.diagonal.z;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);  // eigenvalues rise
  const double longest = solver.eigenvalues()[2];
  Eigen::Vector3d axes;  // in units of the longest
  for (int k = 0; k < 3; ++k) axes[k] = std::max(flattest, std::sqrt(std::max(0.0, solver.eigenvalues()[k]) / longest));
  const Eigen::Matrix3d& turn = solver.eigenvectors();
  const Eigen::Vector3d squares = (radius * axes).cwiseAbs2();
  const Eigen::Matrix3d form = turn * squares.cwiseInverse().asDiagonal() * turn.transpose(),
                        inverse = turn * squares.asDiagonal() * turn.transpose();
  const auto vector = [](double x, double y, double z) { return to_float({x, y, z}); };
  return {{vector(form(0, 0), form(1, 1), form(2, 2)), vector(form(1, 2), form(2, 0), form(0, 1)),
           vector(std::sqrt(inverse(0, 0)), std::sqrt(inverse(1, 1)), std::sqrt(inverse(2, 2)))},
          static_cast<float>(axes.prod())};
}

}  // namespace

void ShapeFinder::run(std::span<Vec3> sources, const Domain& domain, double spacing, double radius,
                      std::vector<SourceShape>& shapes) {
  const auto reach = static_cast<float>(neighbourhood * spacing);
  collect_images(sources, domain, {reach, reach, reach}, unsorted_, origin_);
  CellShape cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.origin[static_cast<std::size_t>(axis)] = static_cast<float>(domain.min[axis]);
    cells.inverse_width[static_cast<std::size_t>(axis)] = 1 / reach;
  }
  grid_.build(cells, unsorted_, order_);
  position_.resize(order_.size());
  parallel_for(order_.size(), [&](std::size_t k) { position_[k] = unsorted_[order_[k]]; });
  shapes.assign(sources.size(), round_shape(radius));
#pragma omp parallel
  {
    Candidates near;
    Grid::Hints hints;
#pragma omp for schedule(dynamic, 8)
    for (std::size_t c = 0; c < grid_.cell_number(); ++c) {
      bool collected = false;
      for (std::uint32_t k = grid_.begin(c); k < grid_.end(c); ++k) {
        const std::uint32_t i = order_[k];
        if (i >= sources.size()) continue;  // an image
        if (!collected) near.collect(cells, grid_, grid_.coordinates(c), position_, hints);
        collected = true;
        const Surroundings s = surroundings(near, position_[k], reach);
        if (s.number < fewest) continue;
        const Flattened found = flattened(s, radius);
        shapes[i] = found.shape;
        sources[i].w /= found.share;
      }
    }
  }
}

std::size_t ShapeFinder::bytes() const {
  return (unsorted_.capacity() + position_.capacity()) * sizeof(Vec3) + origin_.capacity() * sizeof(ImageOrigin) +
         order_.capacity() * sizeof(std::uint32_t) + grid_.bytes();
}

}  // namespace curlew
