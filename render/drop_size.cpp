#include "render/drop_size.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace curlew {
namespace {

constexpr double kCell = 3;  // spacings

struct CountGrid {
  Vec3d origin;
  double cell;
  std::array<int, 3> size;
  std::vector<float> count;

  // Whatever lies outside counts for the cells at the rim; so does what is not a number.
  std::size_t index(std::array<int, 3> at) const {
    std::size_t i = 0;
    for (const std::size_t axis : {2u, 1u, 0u})
      i = i * static_cast<std::size_t>(size[axis]) + static_cast<std::size_t>(std::clamp(at[axis], 0, size[axis] - 1));
    return i;
  }
  // In cells from the first cell's centre, kept within what an int can hold.
  double place(Vec3 p, int axis) const {
    const double cells = (static_cast<double>(p[axis]) - origin[axis]) / cell - 0.5;
    return std::isfinite(cells) ? std::clamp(cells, -1.0, static_cast<double>(size[static_cast<std::size_t>(axis)]))
                                : 0;
  }
};

// The domain and a cell around it. Coarser where the domain is so large that counting it would cost more than drawing.
CountGrid grid_over(const Domain& domain, int dimension, double spacing) {
  CountGrid grid;
  grid.cell = kCell * spacing;
  const Vec3d extent = domain.max - domain.min;
  const auto cells = [&] {
    double all = 1;
    for (int axis = 0; axis < dimension; ++axis) all *= extent[axis] / grid.cell + 2;
    return all;
  };
  while (cells() > 4e6) grid.cell *= 2;
  for (int axis = 0; axis < 3; ++axis) {
    const bool used = axis < dimension;
    grid.size[static_cast<std::size_t>(axis)] = used ? static_cast<int>(std::ceil(extent[axis] / grid.cell)) + 2 : 1;
    grid.origin[axis] = domain.min[axis] - (used ? grid.cell : 0.5 * grid.cell);
  }
  grid.count.assign(static_cast<std::size_t>(grid.size[0]) * static_cast<std::size_t>(grid.size[1]) *
                        static_cast<std::size_t>(grid.size[2]),
                    0);
  return grid;
}

}  // namespace

std::vector<float> crowding(std::span<const Vec3> positions, const Domain& domain, int dimension, double spacing) {
  CountGrid grid = grid_over(domain, dimension, spacing);
  for (const Vec3& p : positions) {
    std::array<int, 3> at{};
    for (int axis = 0; axis < dimension; ++axis)
      at[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(grid.place(p, axis) + 0.5));
    grid.count[grid.index(at)] += 1;
  }

  const double full = std::pow(grid.cell / spacing, dimension);
  std::vector<float> crowded;
  crowded.reserve(positions.size());
  for (const Vec3& p : positions) {
    std::array<int, 3> low{};
    std::array<double, 3> part{};
    for (int axis = 0; axis < dimension; ++axis) {
      const double place = grid.place(p, axis);
      low[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(place));
      part[static_cast<std::size_t>(axis)] = place - std::floor(place);
    }
    double sum = 0;
    for (unsigned corner = 0; corner < 1u << dimension; ++corner) {
      std::array<int, 3> at = low;
      double weight = 1;
      for (unsigned axis = 0; axis < static_cast<unsigned>(dimension); ++axis) {
        const bool upper = corner >> axis & 1u;
        at[axis] += upper;
        weight *= upper ? part[axis] : 1 - part[axis];
      }
      sum += weight * static_cast<double>(grid.count[grid.index(at)]);
    }
    crowded.push_back(static_cast<float>(sum / full));
  }
  return crowded;
}

std::vector<Vec3> sized_particles(const Frame& frame, const DropSize& size) {
  const FrameGeometry& geometry = *frame.geometry;
  std::vector<Vec3> sized = frame.position;
  const auto share = [&](std::size_t i) { return frame.size.empty() ? 1.0f : frame.size[i]; };
  if (size.alone == size.in_water) {
    for (std::size_t i = 0; i < sized.size(); ++i) sized[i].w = share(i);
    return sized;
  }
  const auto crowded = crowding(frame.position, geometry.domain, geometry.dimension, 2 * geometry.particle_radius);
  // A drop alone fills a thirtieth of its cell in 3D, a ninth in 2D; a sheet one particle thick a third.
  const double none = geometry.dimension == 3 ? 0.04 : 0.11, enough = 0.30;
  for (std::size_t i = 0; i < sized.size(); ++i) {
    const double t = std::clamp((static_cast<double>(crowded[i]) - none) / (enough - none), 0.0, 1.0);
    const double grown = t * t * (3 - 2 * t);
    sized[i].w = share(i) * static_cast<float>((size.alone + grown * (size.in_water - size.alone)) / size.in_water);
  }
  return sized;
}

}  // namespace curlew
