#include "sim/sph/bodies.h"

#include <algorithm>

#include "sim/core/parallel.h"
#include "sim/scene/sampling.h"
#include "sim/scene/shapes.h"
#include "sim/sph/neighbours.h"
#include "sim/sph/pair_sums.h"

namespace curlew {

namespace {

// gamma of V_b: what the layers of a half lattice give one spacing off, over what two even layers of samples give.
double volume_share(const Kernel& kernel, double d) {
  double half_lattice = 0;
  for (int layer = 1; layer * d < kernel.support(); ++layer) half_lattice += kernel.layer_sum(d, layer * d);
  const double volume = 1 / (kernel.layer_sum(d, 0) + kernel.layer_sum(d, d));
  return half_lattice / kernel.lattice_sum(d) / (volume * (kernel.layer_sum(d, d) + kernel.layer_sum(d, 2 * d)));
}

// Whether two bodies never move against each other.
bool alike(const Body& one, const Body& other) {
  if (!one.motion.moves() || !other.motion.moves()) return one.motion.moves() == other.motion.moves();
  return one.motion.keyframes() == other.motion.keyframes();
}

}  // namespace

void BodySamples::Extent::include(std::array<int, 3> cell) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], cell[axis] - 1);
    high[axis] = std::max(high[axis], cell[axis] + 1);
  }
}

bool BodySamples::Extent::holds(const CellShape& shape, std::array<int, 3> cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (shape.periodic_cells[axis] == 0 && (cell[axis] < low[axis] || cell[axis] > high[axis])) return false;
  }
  return high[0] >= low[0];
}

BodySamples::BodySamples(const Scene& scene, const CellShape& shape, const Kernel& kernel) {
  std::vector<Origin> all;
  std::vector<Vec3> unsorted;
  std::vector<std::uint32_t> group;  // the first body that moves alike, or rests alike
  std::vector<bool> moving;
  for (const Body& body : scene.bodies) {
    const auto number = static_cast<std::uint32_t>(moving.size());
    const bool moves = body.motion.moves();
    const Vec3d first = moves ? body.motion.keyframes().front().at : Vec3d{};
    moving.push_back(moves);
    const auto same = static_cast<std::uint32_t>(
        std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& other) { return alike(body, other); }) -
        scene.bodies.begin());
    for (Vec3d point : sample_body(body.shape, scene.spacing(), scene.dimension, domain_around(body, scene.domain))) {
      all.push_back({point, number, 0, body.kind == WallKind::no_slip ? 1.0f : 0.0f});
      unsorted.push_back(to_float(point + first));
      group.push_back(same);
    }
  }
  sort(shape, unsorted);
  for (std::uint32_t k : order_) no_slip_.push_back(all[k].no_slip);
  any_no_slip_ = std::any_of(no_slip_.begin(), no_slip_.end(), [](float flag) { return flag > 0; });
  find_volumes(shape, kernel, scene.spacing(), group);
  if (std::find(moving.begin(), moving.end(), true) == moving.end()) {
    order_ = std::vector<std::uint32_t>();  // gives the memory back
    return;
  }
  for (std::size_t k = 0; k < order_.size(); ++k) all[order_[k]].volume = volume_[k];
  origin_ = std::move(all);
  moving_ = std::move(moving);
  place(shape, body_places(scene.bodies, 0));
}

void BodySamples::sort(const CellShape& shape, std::span<const Vec3> unsorted) {
  grid_.build(shape, unsorted, order_);
  position_.resize(unsorted.size());
  extent_ = {};
  for (std::size_t k = 0; k < order_.size(); ++k) {
    position_[k] = unsorted[order_[k]];
    extent_.include(shape.cell_of(position_[k]));
  }
}

void BodySamples::find_volumes(const CellShape& shape, const Kernel& kernel, double spacing,
                               std::span<const std::uint32_t> group) {
  NeighbourLists lists;
  lists.build(shape, grid_, position_, kernel.support());
  volume_.resize(position_.size());
  const double share = volume_share(kernel, spacing);
  parallel_for(position_.size(), [&](std::size_t i) {
    double total = kernel.value(0.0);
    for (std::size_t k = 0; k < lists.count(i); ++k) {
      const std::uint32_t j = lists.begin(i)[k];
      if (group[order_[i]] != group[order_[j]]) continue;
      Vec3 x = position_[i] - position_[j];
      for (int axis = 0; axis < 3; ++axis) {
        if (shape.period[axis] > 0) x[axis] -= shape.period[axis] * std::nearbyint(x[axis] / shape.period[axis]);
      }
      total += kernel.value(length(x));
    }
    volume_[i] = static_cast<float>(share / total);
  });
}

void BodySamples::place(const CellShape& shape, std::span<const BodyPlace> places) {
  if (!any_moving()) return;
  unsorted_.resize(origin_.size());
  for (std::size_t k = 0; k < origin_.size(); ++k) {
    unsorted_[k] = to_float(origin_[k].at + places[origin_[k].body].offset);
  }
  sort(shape, unsorted_);
  moving_extent_ = {};
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const Origin& origin = origin_[order_[k]];
    volume_[k] = origin.volume;
    no_slip_[k] = origin.no_slip;
    if (moving_[origin.body]) moving_extent_.include(shape.cell_of(position_[k]));
  }
  set_velocities(places);
}

void BodySamples::set_velocities(std::span<const BodyPlace> places) {
  velocity_.resize(origin_.size());
  for (std::size_t k = 0; k < velocity_.size(); ++k) velocity_[k] = to_float(places[origin_[order_[k]].body].velocity);
}

bool BodySamples::moving_near(const CellShape& shape, std::array<int, 3> cell) const {
  return any_moving() && moving_extent_.holds(shape, cell);
}

void BodySamples::collect(const CellShape& shape, std::array<int, 3> cell, Candidates& near, Grid::Hints& hints) const {
  near.size = 0;
  if (count() > 0 && extent_.holds(shape, cell)) near.collect(shape, grid_, cell, position_, hints);
}

MotionSum BodySamples::motion(Vec3 here, const Candidates& near, const Kernel& kernel, float rest_density) const {
  const auto support2 = static_cast<float>(kernel.support() * kernel.support());
  f8 rate{};
  VectorSum curl, friction;
  for (std::size_t k = 0; k < near.size; k += 8) {
    const auto o = near.offsets(here, k);
    const i8 inside = o.r2 < support2;
    const f8 r2 = min(o.r2, splat(support2)), zero{};
    const f8 slope = kernel.slope(r2);
    const Vec8 v = gather(velocity_.data(), &near.number[k]);
    const f8 strength = inside ? gather(volume_.data(), &near.number[k]) * slope : zero;
    const f8 x = inside ? o.x : zero, y = inside ? o.y : zero, z = inside ? o.z : zero;
    rate += strength * (v.x * x + v.y * y + v.z * z);
    if (!any_no_slip_) continue;
    const f8 rough = inside ? gather(no_slip_.data(), &near.number[k]) : zero;
    const f8 turning = rough * strength;
    curl.add(turning * (v.y * z - v.z * y), turning * (v.z * x - v.x * z), turning * (v.x * y - v.y * x));
    const f8 pull = -2.0f * rough * 2.0f * strength * r2 / (r2 + kernel.softening());
    friction.add(pull * v.x, pull * v.y, pull * v.z);
  }
  MotionSum sums{rest_density * curl.total(), friction.total()};
  sums.motion.w = rest_density * sum(rate);
  return sums;
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
         grid_.bytes() + order_.capacity() * sizeof(std::uint32_t) + origin_.capacity() * sizeof(Origin) +
         (unsorted_.capacity() + velocity_.capacity()) * sizeof(Vec3);
}

}  // namespace curlew
