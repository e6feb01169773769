// The particles' wavelet energy beside that of a background grid (Fujisawa et al. 2011, Fig. 1): velocities are
// projected onto nodes, the transform is taken there, with all nodes that the wavelet reaches, and its energy is read
// back at the particles.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/core/parallel.h"
#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

constexpr int per_metre = 26, nodes = 2 * per_metre;  // along each edge of a periodic cube of 1 m
constexpr double spacing = 1.0 / per_metre, cell = spacing / 2, scale = spacing / 2;

int wrapped(int i) { return (i % nodes + nodes) % nodes; }

std::size_t node(int i, int j, int k) {
  return static_cast<std::size_t>((wrapped(k) * nodes + wrapped(j)) * nodes + wrapped(i));
}

// Calls visit(i, j, k, offset) for the nodes within `reach` (m) of a point; offset (m) is from the node to it.
template <class Visit>
void for_nodes(Vec3d x, double reach, Visit&& visit) {
  const auto from = [&](double a) { return static_cast<int>(std::ceil((a - reach) / cell)); };
  const auto to = [&](double a) { return static_cast<int>(std::floor((a + reach) / cell)); };
  for (int k = from(x.z); k <= to(x.z); ++k) {
    for (int j = from(x.y); j <= to(x.y); ++j) {
      for (int i = from(x.x); i <= to(x.x); ++i) {
        const Vec3d offset = x - cell * Vec3d{double(i), double(j), double(k)};
        if (dot(offset, offset) <= reach * reach) visit(i, j, k, offset);
      }
    }
  }
}

// Velocities at the nodes: a linear function fitted to the particles around each, Gaussian weights half a spacing wide.
std::vector<Vec3d> projected(const World& world) {
  const double width = spacing / 2;
  std::vector<Eigen::Matrix4d> moments(nodes * nodes * nodes, Eigen::Matrix4d::Zero());
  std::vector<Eigen::Matrix<double, 4, 3>> sums(moments.size(), Eigen::Matrix<double, 4, 3>::Zero());
  for (std::size_t p = 0; p < world.count; ++p) {
    const Vec3d u = to_double(world.fields.velocity[p]);
    for_nodes(to_double(world.fields.position[p]), 2.5 * width, [&](int i, int j, int k, Vec3d offset) {
      const Eigen::Vector4d linear(1, offset.x / width, offset.y / width, offset.z / width);
      const double weight = std::exp(-dot(offset, offset) / (2 * width * width));
      moments[node(i, j, k)] += weight * linear * linear.transpose();
      sums[node(i, j, k)] += weight * linear * Eigen::RowVector3d(u.x, u.y, u.z);
    });
  }
  std::vector<Vec3d> velocity(moments.size());
  for (std::size_t n = 0; n < velocity.size(); ++n) {
    const Eigen::RowVector3d u = moments[n].ldlt().solve(sums[n]).row(0);
    velocity[n] = {u[0], u[1], u[2]};
  }
  return velocity;
}

// |u^|^2 / 2 at the nodes, u^ = sum (u_j - u_i) psi / sum |psi|.
std::vector<double> transformed(const std::vector<Vec3d>& velocity) {
  std::vector<double> energy(velocity.size());
  parallel_for(energy.size(), [&](std::size_t n) {
    const int i = static_cast<int>(n) % nodes, j = static_cast<int>(n) / nodes % nodes,
              k = static_cast<int>(n) / (nodes * nodes);
    Vec3d sum{};
    double weights = 0;
    for_nodes(cell * Vec3d{double(i), double(j), double(k)}, 4 * scale, [&](int a, int b, int c, Vec3d offset) {
      const double q2 = dot(offset, offset) / (scale * scale), psi = (3 - q2) * std::exp(-q2 / 2);
      sum += psi * (velocity[node(a, b, c)] - velocity[n]);
      weights += std::abs(psi);
    });
    energy[n] = dot(sum, sum) / (2 * weights * weights);
  });
  return energy;
}

double interpolated(const std::vector<double>& field, Vec3d x) {
  double sum = 0;
  for_nodes(x, std::sqrt(3.0) * cell, [&](int i, int j, int k, Vec3d offset) {
    const auto hat = [](double a) { return std::max(0.0, 1 - std::abs(a) / cell); };
    sum += hat(offset.x) * hat(offset.y) * hat(offset.z) * field[node(i, j, k)];
  });
  return sum;
}

struct Agreement {
  double correlation = 0, ratio = 0;  // of the energies, and the particles' sum over the grid's
};

Agreement agreement(const World& world) {
  const std::vector<double> grid = transformed(projected(world));
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < world.count; ++i) {
    const double p = double{world.fields.wavelet_energy[i]},
                 g = interpolated(grid, to_double(world.fields.position[i]));
    a += p, b += g, aa += p * p, bb += g * g, ab += p * g;
  }
  const auto n = static_cast<double>(world.count);
  return {(n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b)), a / b};
}

}  // namespace

TEST_CASE("a background grid finds wavelet energy where the particles do, less what it blurs") {
  Scene scene = empty_box({1, 1, 1}, per_metre);
  scene.gravity = {};
  scene.domain.periodic = {true, true, true};
  scene.parameters.pressure.two_sided = true;
  scene.parameters.wavelet.scale = scale / spacing;
  scene.fluid.push_back(moving(Box{{0, 0, 0}, {1, 1, 1}}, {}));
  World world = jittered(make_world(scene), 0.1);
  const double k = 4 * std::numbers::pi;
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3d x = to_double(world.fields.position[i]);
    world.fields.velocity[i] =
        to_float(Vec3d{std::sin(k * x.z) + 0.7 * std::cos(k * x.y), 0.8 * std::sin(k * x.x) + std::cos(k * x.z),
                       0.7 * std::sin(k * x.y) + 0.8 * std::cos(k * x.x)});
  }
  Run run(std::move(world), {FieldId::wavelet_energy});
  {
    // Waves thirteen spacings long: the projection takes some 7 % of their second derivatives.
    const Agreement smooth = agreement(run.world);
    CAPTURE(smooth.correlation, smooth.ratio);
    CHECK(smooth.correlation > 0.99);
    CHECK(smooth.ratio > 1);
    CHECK(smooth.ratio < 1.2);
  }
  {
    // After some steps neighbours also move against each other, which particles see and a projection hardly does. How
    // well the two agree then is chance: correlations from 0.2 to 0.6 were seen.
    run.simulate(0.5);
    const Agreement running = agreement(run.world);
    CAPTURE(running.correlation, running.ratio);
    CHECK(running.ratio > 2);
    CHECK(running.ratio < 10);
  }
}
