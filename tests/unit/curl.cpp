// The two forms of the curl at a free surface: 21 x 21 particles on a lattice in rigid rotation (Bender, Koschier,
// Kugelstadt & Weiler 2018, Fig. 2, who read off -21.2 and -0.8).
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sim/core/passes.h"
#include "sim/sph/pair_sums.h"

using namespace curlew;

namespace {

World disc_of_lattice(double h_over_d) {
  Scene scene;
  scene.dimension = 2;
  scene.particle_radius = 0.5;
  scene.gravity = {};
  scene.domain.min = {-12.5, -12.5, 0};
  scene.domain.max = {12.5, 12.5, 0};
  scene.domain.walls.fill({WallKind::open, {}});
  Fluid fluid{Box{{-10.5, -10.5, 0}, {10.5, 10.5, 0}}, {}};
  fluid.velocity.field = InitialVelocity::Field::rotation;
  fluid.velocity.rate = {0, 0, 1};
  scene.fluid.push_back(fluid);
  scene.parameters.sph.h_over_d = h_over_d;
  World world = make_world(scene);
  prepare(world, make_plan(world));
  return world;
}

double difference_curl(const World& world, std::size_t i) {
  const Fields& f = world.fields;
  VectorSum curl;
  for_pairs(world.neighbours, f.position.data(), i, Open{}, [&](const Pairs& p) {
    curl.add_curl(world.kernel.slope(p.r2), f.velocity[i], gather(f.velocity.data(), p.j), p);
  });
  return double{world.mass} / double{f.density[i]} * double{curl.total().z};
}

// -sum m (a_i + a_j) x grad W.
double symmetric_sum(const World& world, const Array<Vec3>& a, std::size_t i) {
  VectorSum curl;
  for_pairs(world.neighbours, world.fields.position.data(), i, Open{}, [&](const Pairs& p) {
    // A list is padded with the particle itself: there x_ij = 0, so that its 2 a_i adds nothing.
    curl.add_curl_symmetric(world.kernel.slope(p.r2), a[i], gather(a.data(), p.j), p);
  });
  return double{world.mass} * double{curl.total().z};
}

struct Errors {
  double least = 1e9, most = -1e9;
  void take(double error) {
    least = std::min(least, error);
    most = std::max(most, error);
  }
};

}  // namespace

TEST_CASE("the curl of 21 x 21 particles in rigid rotation errs as in the paper", "[curl]") {
  // Recomputed from Fig. 2 in double precision: cubic spline, spacing 1, rotation rate 1 (curl 2), density from the sum
  // that includes the particle itself; error = curl - 2.
  struct Row {
    double support, symmetric_least, symmetric_most, difference_least, difference_most;
  };
  const Row row = GENERATE(Row{2.0, -21.1834, 4.6675, -0.7976, 0.0245}, Row{2.4, -19.9040, 5.2372, -0.7191, -0.0179},
                           Row{2.6, -19.1933, 4.4391, -0.6676, 0.0212}, Row{3.0, -17.5753, 2.5835, -0.6258, 0.0065},
                           Row{4.0, -14.5392, 3.2725, -0.5413, -0.0017});
  const World world = disc_of_lattice(row.support / 2);
  REQUIRE(world.count == 21 * 21);
  Array<Vec3> scaled(world.count);
  for (std::size_t i = 0; i < world.count; ++i) {
    const float rho = world.fields.density[i];
    scaled[i] = 1 / (rho * rho) * world.fields.velocity[i];
  }
  Errors difference, symmetric;
  for (std::size_t i = 0; i < world.count; ++i) {
    difference.take(difference_curl(world, i) - 2);
    symmetric.take(double{world.fields.density[i]} * symmetric_sum(world, scaled, i) - 2);
  }
  INFO("support " << row.support << " d: difference " << difference.least << " to " << difference.most << ", symmetric "
                  << symmetric.least << " to " << symmetric.most);
  CHECK(std::abs(difference.least - row.difference_least) < 0.005);
  CHECK(std::abs(difference.most - row.difference_most) < 0.005);
  CHECK(std::abs(symmetric.least - row.symmetric_least) < 0.05);
  CHECK(std::abs(symmetric.most - row.symmetric_most) < 0.05);
}

TEST_CASE("the symmetric curl is the adjoint of the difference curl, and its pairs cancel", "[curl]") {
  World world = disc_of_lattice(1);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(-1, 1);
  Array<Vec3> spin(world.count), scaled(world.count);
  for (std::size_t i = 0; i < world.count; ++i) {
    world.fields.velocity[i] = {any(random), any(random), 0};
    spin[i] = {0, 0, any(random)};
    scaled[i] = 1 / world.fields.density[i] * spin[i];
  }
  double left = 0, right = 0, size = 0;
  Vec3d push;
  for (std::size_t i = 0; i < world.count; ++i) {
    VectorSum force;
    for_pairs(world.neighbours, world.fields.position.data(), i, Open{}, [&](const Pairs& p) {
      force.add_curl_symmetric(world.kernel.slope(p.r2), scaled[i], gather(scaled.data(), p.j), p);
    });
    const Vec3d f = double{world.mass} * to_double(force.total());
    left += double{spin[i].z} * difference_curl(world, i);
    right += dot(to_double(world.fields.velocity[i]), f);
    push += f;
    size += length(f);
  }
  CHECK(left == Approx(right).epsilon(1e-5));
  CHECK(length(push) < 1e-5 * size);
}
