#include "app/cavity_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/parallel.h"
#include "sim/sph/candidates.h"

namespace curlew {
namespace {

// Weighted moments of places and velocities, from which the plane follows.
struct PlaneFit {
  double weight = 0;
  Vec3d x, v;  // sums
  double xx = 0, xy = 0, yy = 0;
  Vec3d vx, vy;  // sums of v x, v y

  void add(double w, Vec3d place, Vec3d velocity) {
    weight += w;
    x += w * place;
    v += w * velocity;
    xx += w * place.x * place.x;
    xy += w * place.x * place.y;
    yy += w * place.y * place.y;
    vx += w * place.x * velocity;
    vy += w * place.y * velocity;
  }

  // At the place 0. Where all places are on a line, the mean.
  Vec3d value() const {
    if (!(weight > 0)) return {};
    const Vec3d centre = 1 / weight * x, mean = 1 / weight * v;
    const double a = xx / weight - centre.x * centre.x, b = xy / weight - centre.x * centre.y,
                 c = yy / weight - centre.y * centre.y, determinant = a * c - b * b;
    if (!(determinant > 1e-6 * (a + c) * (a + c))) return mean;
    const Vec3d p = 1 / weight * vx - centre.x * mean, q = 1 / weight * vy - centre.y * mean;
    const Vec3d slope_x = 1 / determinant * (c * p - b * q), slope_y = 1 / determinant * (a * q - b * p);
    return mean - centre.x * slope_x - centre.y * slope_y;
  }
};

// Successive over-relaxation (Young 1954) with the factor that is best for this square; over in a second at 200 x 200.
void solve_poisson(NodeField& psi, const NodeField& source) {
  const std::size_t n = psi.across;
  const double step = 1 / static_cast<double>(n), factor = 2 / (1 + std::sin(std::numbers::pi * step));
  double largest = 0;
  for (const double s : source.values) largest = std::max(largest, std::abs(s));
  for (double change = 1, sweeps = 0; change > 1e-11 * largest && sweeps < 20.0 * static_cast<double>(n); ++sweeps) {
    change = 0;
    for (std::size_t j = 1; j < n; ++j) {
      for (std::size_t i = 1; i < n; ++i) {
        const double around = psi.at(i - 1, j) + psi.at(i + 1, j) + psi.at(i, j - 1) + psi.at(i, j + 1);
        const double by = factor * ((around - step * step * source.at(i, j)) / 4 - psi.at(i, j));
        psi.at(i, j) += by;
        change = std::max(change, std::abs(by));
      }
    }
  }
}

bool is_extremum(const NodeField& psi, std::size_t i, std::size_t j) {
  const double sign = psi.at(i, j) > 0 ? 1 : -1;
  for (std::size_t l = j < 2 ? 0 : j - 2; l <= std::min(psi.across, j + 2); ++l) {
    for (std::size_t k = i < 2 ? 0 : i - 2; k <= std::min(psi.across, i + 2); ++k) {
      if ((k != i || l != j) && sign * psi.at(k, l) >= sign * psi.at(i, j)) return false;
    }
  }
  return true;
}

// Where the parabola through three values, a step apart, has its extremum, in steps from the middle one.
double parabola_peak(double before, double here, double after) {
  const double curvature = before - 2 * here + after;
  return curvature == 0 ? 0 : (before - after) / (2 * curvature);
}

// The corner that a place is in; empty outside of all.
std::string corner_of(double x, double y) {
  constexpr double reach = 0.4;
  if (y < reach) return x > 1 - reach ? "BR" : x < reach ? "BL" : "";
  return y > 1 - reach && x < reach ? "TL" : "";
}

}  // namespace

Vec3d fitted_velocity(const World& world, Vec3d point) {
  const Vec3 here = to_float(point);
  Candidates near;
  Grid::Hints hints;
  near.collect(world.cells, world.grid, world.cells.cell_of(here), world.fields.position, hints);
  Reflection images[Walls::most_reflections];
  const int number = world.walls.reflections(here, images);
  PlaneFit fit;
  for (std::size_t k = 0; k < near.size; ++k) {
    const Vec3d x = Vec3d{near.x[k], near.y[k], 0} - point, v = to_double(world.fields.velocity[near.number[k]]);
    fit.add(world.kernel.value(length(x)), x, v);
    for (int image = 0; image < number; ++image) {
      const Reflection& r = images[image];
      const Vec3d mirrored{r.sign.x * x.x - r.offset.x, r.sign.y * x.y - r.offset.y, 0};
      fit.add(world.kernel.value(length(mirrored)), mirrored,
              {r.velocity_sign.x * v.x + r.velocity_offset.x, r.velocity_sign.y * v.y + r.velocity_offset.y, 0});
    }
  }
  return fit.value();
}

void VelocityMean::add(const World& world, double seconds) {
  parallel_for(points_.size(), [&](std::size_t k) { sums_[k] += seconds * fitted_velocity(world, points_[k]); });
  seconds_ += seconds;
}

NodeField stream_function(const NodeField& u, const NodeField& v) {
  const std::size_t n = u.across;
  NodeField source(n), psi(n);
  for (std::size_t j = 1; j < n; ++j) {
    for (std::size_t i = 1; i < n; ++i) {
      const double twice = u.at(i, j + 1) - u.at(i, j - 1) - v.at(i + 1, j) + v.at(i - 1, j);
      source.at(i, j) = twice * static_cast<double>(n) / 2;
    }
  }
  solve_poisson(psi, source);
  return psi;
}

std::vector<CavityVortex> cavity_vortices(const NodeField& psi, double least) {
  const std::size_t n = psi.across;
  std::vector<CavityVortex> found;
  for (std::size_t j = 1; j < n; ++j) {
    for (std::size_t i = 1; i < n; ++i) {
      const double value = psi.at(i, j), step = 1 / static_cast<double>(n);
      if (!(std::abs(value) >= least) || !is_extremum(psi, i, j)) continue;
      const double x = step * (static_cast<double>(i) + parabola_peak(psi.at(i - 1, j), value, psi.at(i + 1, j)));
      const double y = step * (static_cast<double>(j) + parabola_peak(psi.at(i, j - 1), value, psi.at(i, j + 1)));
      const std::string corner = corner_of(x, y);
      const bool primary = corner.empty() && value < 0;
      if (corner.empty() && !primary) continue;
      const CavityVortex here{primary ? "PV" : corner + (value > 0 ? "1" : "2"), value, x, y};
      const auto same =
          std::find_if(found.begin(), found.end(), [&](const CavityVortex& other) { return other.name == here.name; });
      if (same == found.end()) {
        found.push_back(here);
      } else if (std::abs(value) > std::abs(same->psi)) {
        *same = here;
      }
    }
  }
  std::sort(found.begin(), found.end(),
            [](const CavityVortex& a, const CavityVortex& b) { return std::abs(a.psi) > std::abs(b.psi); });
  return found;
}

}  // namespace curlew
