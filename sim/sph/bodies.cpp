#include "sim/sph/bodies.h"

#include <algorithm>

#include "sim/core/parallel.h"
#include "sim/scene/sampling.h"
#include "sim/sph/neighbours.h"

namespace curlew {

namespace {

// gamma of V_b: what the layers of a half lattice give one spacing off, over what two even layers of samples give.
double volume_share(const Kernel& kernel, double d) {
  double half_lattice = 0;
  for (int layer = 1; layer * d < kernel.support(); ++layer) half_lattice += kernel.layer_sum(d, layer * d);
  const double volume = 1 / (kernel.layer_sum(d, 0) + kernel.layer_sum(d, d));
  return half_lattice / kernel.lattice_sum(d) / (volume * (kernel.layer_sum(d, d) + kernel.layer_sum(d, 2 * d)));
}

}  // namespace

BodySamples::BodySamples(const Scene& scene, const CellShape& shape, const Kernel& kernel) {
  std::vector<Vec3> unsorted;
  std::vector<float> no_slip;
  for (const Body& body : scene.bodies) {
    for (Vec3d point : sample_body(body.shape, scene.spacing(), scene.dimension, scene.domain)) {
      unsorted.push_back(to_float(point));
      no_slip.push_back(body.kind == WallKind::no_slip ? 1.0f : 0.0f);
    }
  }
  std::vector<std::uint32_t> order;
  grid_.build(shape, unsorted, order);
  for (std::uint32_t k : order) {
    position_.push_back(unsorted[k]);
    no_slip_.push_back(no_slip[k]);
  }
  any_no_slip_ = std::any_of(no_slip.begin(), no_slip.end(), [](float flag) { return flag > 0; });

  low_ = {INT32_MAX, INT32_MAX, INT32_MAX};
  high_ = {INT32_MIN, INT32_MIN, INT32_MIN};
  for (Vec3 point : position_) {
    const auto cell = shape.cell_of(point);
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], cell[axis] - 1);
      high_[axis] = std::max(high_[axis], cell[axis] + 1);
    }
  }

  NeighbourLists lists;
  lists.build(shape, grid_, position_, kernel.support());
  volume_.resize(position_.size());
  const double share = volume_share(kernel, scene.spacing());
  parallel_for(position_.size(), [&](std::size_t i) {
    double total = kernel.value(0.0);
    for (std::size_t k = 0; k < lists.count(i); ++k) {
      Vec3 x = position_[i] - position_[lists.begin(i)[k]];
      for (int axis = 0; axis < 3; ++axis) {
        if (shape.period[axis] > 0) x[axis] -= shape.period[axis] * std::nearbyint(x[axis] / shape.period[axis]);
      }
      total += kernel.value(length(x));
    }
    volume_[i] = static_cast<float>(share / total);
  });
}

void BodySamples::collect(const CellShape& shape, std::array<int, 3> cell, Candidates& near, Grid::Hints& hints) const {
  near.size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (shape.periodic_cells[axis] == 0 && (cell[axis] < low_[axis] || cell[axis] > high_[axis])) return;
  }
  if (count() > 0) near.collect(shape, grid_, cell, position_, hints);
}

void BodySamples::add(WallSum& total, Vec3 here, const Candidates& near, const Kernel& kernel,
                      float rest_density) const {
  const auto support2 = static_cast<float>(kernel.support() * kernel.support());
  f8 density{}, x{}, y{}, z{}, pull{}, number{}, rough_x{}, rough_y{}, rough_z{};
  for (std::size_t k = 0; k < near.size; k += 8) {
    const auto o = near.offsets(here, k);
    const i8 inside = o.r2 < support2;
    const f8 volume = inside ? gather(volume_.data(), &near.number[k]) : f8{};
    const f8 r2 = min(o.r2, splat(support2));
    const f8 slope = volume * kernel.slope(r2);
    const f8 zero{};
    density += volume * kernel.value(r2);
    x += inside ? slope * o.x : zero;
    y += inside ? slope * o.y : zero;
    z += inside ? slope * o.z : zero;
    number += inside ? zero + 1.0f : zero;
    // Twice: the layers behind the sampled one move against the fluid, so that the velocity vanishes at the surface.
    if (any_no_slip_) {
      const f8 rough = inside ? gather(no_slip_.data(), &near.number[k]) : zero;
      rough_x += rough * slope * o.x;
      rough_y += rough * slope * o.y;
      rough_z += rough * slope * o.z;
      pull -= 2.0f * rough * 2.0f * slope * r2 / (r2 + kernel.softening());
    }
  }
  total.gradient += rest_density * Vec3{sum(x), sum(y), sum(z)};
  total.neighbours += sum(number);
  total.gradient.w += rest_density * sum(density);
  total.friction.w += sum(pull);
  total.no_slip_gradient += rest_density * Vec3{sum(rough_x), sum(rough_y), sum(rough_z)};
}

std::size_t BodySamples::bytes() const {
  return position_.capacity() * sizeof(Vec3) + (volume_.capacity() + no_slip_.capacity()) * sizeof(float) +
         grid_.bytes();
}

}  // namespace curlew
