#include "sim/sph/density.h"

#include <cmath>
#include <limits>

#include "sim/core/parallel.h"
#include "sim/sph/velocity_gradient.h"

namespace curlew {

void sort_particles(World& world) {
  world.grid.build(world.cells, world.fields.position, world.order);
#define CURLEW_SORT(name, type, unit, kind, doc)                                                                       \
  if constexpr (is_state(FieldKind::kind)) {                                                                           \
    if (!world.fields.name.empty()) {                                                                                  \
      world.sort_space.name.resize(world.count);                                                                       \
      parallel_for(world.count, [&](std::size_t k) { world.sort_space.name[k] = world.fields.name[world.order[k]]; }); \
      world.fields.name.swap(world.sort_space.name);                                                                   \
    }                                                                                                                  \
  }
  CURLEW_FIELDS(CURLEW_SORT)
#undef CURLEW_SORT
}

void find_neighbours(World& world) {
  world.neighbours.build(world.cells, world.grid, world.fields.position, world.kernel.support());
}

void boundary_sums(World& world) {
  Fields& f = world.fields;
  const bool friction = !f.boundary_friction.empty(), no_slip = !f.no_slip_gradient.empty();
  const Grid& grid = world.grid;
  constexpr std::size_t chunk = 16;
#pragma omp parallel
  {
    Candidates near;
    Grid::Hints hints;
#pragma omp for schedule(dynamic, 1)
    for (std::size_t first = 0; first < grid.cell_number(); first += chunk) {
      for (std::size_t cell = first; cell < std::min(first + chunk, grid.cell_number()); ++cell) {
        world.bodies.collect(world.cells, grid.coordinates(cell), near, hints);
        for (std::uint32_t i = grid.begin(cell); i < grid.end(cell); ++i) {
          WallSum total = world.walls.sum(f.position[i]);
          if (near.size > 0) world.bodies.add(total, f.position[i], near, world.kernel, world.rest_density());
          f.boundary_gradient[i] = total.gradient;
          f.neighbour_number[i] = total.neighbours;
          if (friction) f.boundary_friction[i] = total.friction;
          if (no_slip) f.no_slip_gradient[i] = total.no_slip_gradient;
        }
      }
    }
  }
}

// |sum m B grad W|^2 + sum |m B grad W|^2.
template <class Images>
float corrected_diagonal(const World& world, std::size_t i, const SymmetricMatrix& b, const Images& images) {
  const Vec3 d = b.diagonal, e = b.mixed;
  VectorSum total;
  f8 squared{};
  const auto add = [&](f8 slope, const Pairs& p) {
    const f8 x = slope * (d.x * p.x + e.z * p.y + e.y * p.z), y = slope * (e.z * p.x + d.y * p.y + e.x * p.z),
             z = slope * (e.y * p.x + e.x * p.y + d.z * p.z);
    total.add(x, y, z);
    squared += x * x + y * y + z * z;
  };
  for_pairs(world.neighbours, world.fields.position.data(), i, images,
            [&](const Pairs& p) { add(world.kernel.slope(p.r2), p); });
  for_reflected_pairs(world, i, images,
                      [&](const Pairs& p, f8 weight, const Reflection&) { add(weight * world.kernel.slope(p.r2), p); });
  Vec3 sums = world.mass * total.total();
  if (world.bodies.count() > 0) {
    sums += world.fields.boundary_gradient[i] - world.walls.sum(world.fields.position[i]).gradient;
  }
  return dot(sums, sums) + world.mass * world.mass * sum(squared);
}

void gradient_correction(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      f8 xx{}, yy{}, zz{}, yz{}, zx{}, xy{};
      const auto add = [&](f8 slope, const Pairs& p) {
        xx -= slope * p.x * p.x;
        yy -= slope * p.y * p.y;
        zz -= slope * p.z * p.z;
        yz -= slope * p.y * p.z;
        zx -= slope * p.z * p.x;
        xy -= slope * p.x * p.y;
      };
      for_pairs(world.neighbours, f.position.data(), i, images,
                [&](const Pairs& p) { add(world.kernel.slope(p.r2), p); });
      for_reflected_pairs(world, i, images, [&](const Pairs& p, f8 weight, const Reflection&) {
        add(weight * world.kernel.slope(p.r2), p);
      });
      const float volume = world.mass / f.density[i];
      const SymmetricMatrix b = gradient_correction(volume * Vec3{sum(xx), sum(yy), sum(zz)},
                                                    volume * Vec3{sum(yz), sum(zx), sum(xy)}, world.scene.dimension)
                                    .matrix;
      f.correction_diagonal[i] = b.diagonal;
      f.correction_mixed[i] = b.mixed;
      if (!f.corrected_diagonal.empty()) f.corrected_diagonal[i] = corrected_diagonal(world, i, b, images);
    });
  });
}

void compute_density(World& world) {
  count_sweep(world);
  Fields& f = world.fields;
  const bool boundary = world.has_boundary();
  const float mass = world.mass;
  const float self = mass * static_cast<float>(world.kernel.value(0.0));
  with_images(world.cells, [&](auto images) {
    parallel_for(world.count, [&](std::size_t i) {
      f8 value{}, x{}, y{}, z{}, squared{};
      for_pairs(world.neighbours, f.position.data(), i, images, [&](const Pairs& p) {
        const f8 slope = world.kernel.slope(p.r2);
        value += world.kernel.value(p.r2);
        x += slope * p.x;
        y += slope * p.y;
        z += slope * p.z;
        squared += slope * slope * p.r2;
      });
      const auto padding = static_cast<float>(world.neighbours.groups(i) * 8 - world.neighbours.count(i));
      float density = mass * sum(value) + (1 - padding) * self;
      Vec3 gradient = mass * Vec3{sum(x), sum(y), sum(z)};
      float number = static_cast<float>(world.neighbours.count(i));
      if (boundary) {
        density += f.boundary_gradient[i].w;
        gradient += f.boundary_gradient[i];
        number += f.neighbour_number[i];
      }
      f.density[i] = density;
      f.neighbour_number[i] = number;
      // A particle alone has no diagonal and no source: the smallest number keeps the division finite.
      f.diagonal[i] = dot(gradient, gradient) + mass * mass * sum(squared) + std::numeric_limits<float>::min();
    });
  });
  struct Compression {
    double sum = 0, max = 0;
    void operator+=(const Compression& other) {
      sum += other.sum;
      max = std::max(max, other.max);
    }
  };
  const auto compression = ordered_sum<Compression>(world.count, [&](std::size_t begin, std::size_t end) {
    Compression part;
    for (std::size_t i = begin; i < end; ++i) {
      const double excess = std::max(0.0, double{f.density[i]} / world.parameters().sph.rest_density - 1);
      part += {excess, excess};
    }
    return part;
  });
  world.report.density_error_true_avg = compression.sum / static_cast<double>(std::max<std::size_t>(1, world.count));
  world.report.density_error_true_max = compression.max;
}

}  // namespace curlew
