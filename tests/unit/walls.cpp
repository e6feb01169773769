// Wall integrals against the lattice that they stand for.
#include "sim/sph/walls.h"

#include <catch2/catch.hpp>

using namespace curlew;

namespace {

constexpr double d = 0.05;

struct Setup {
  Kernel kernel;
  double mass;
  Walls walls;
  int dimension;
  explicit Setup(int dim) : kernel(d, dim), mass(1000 / kernel.lattice_sum(d)), dimension(dim) {
    Domain domain;
    domain.max = {1, 1, 1};
    walls = Walls(domain, dim, kernel, d, mass);
  }

  // Density of the whole lattice x = (n + 1/2) d at a lattice point, from inside points and from the walls.
  double density_at(int nx, int ny, int nz) const {
    const Vec3d here{(nx + 0.5) * d, (ny + 0.5) * d, dimension == 3 ? (nz + 0.5) * d : 0};
    double inside = 0;
    const int last_z = dimension == 3 ? 19 : 0;
    for (int x = 0; x < 20; ++x) {
      for (int y = 0; y < 20; ++y) {
        for (int z = 0; z <= last_z; ++z) {
          const Vec3d there{(x + 0.5) * d, (y + 0.5) * d, dimension == 3 ? (z + 0.5) * d : 0};
          inside += mass * kernel.value(length(here - there));
        }
      }
    }
    return inside + static_cast<double>(walls.sum(to_float(here)).gradient.w);
  }
};

}  // namespace

TEST_CASE("a lattice that touches the walls has rest density at faces, edges and corners", "[walls]") {
  for (int dimension : {2, 3}) {
    const Setup setup(dimension);
    // A layer smeared over its plane differs from the lattice's own sum by this much.
    const double smeared = dimension == 3 ? 4e-4 : 1.6e-3;
    for (int nx : {0, 1, 2, 10, 19}) {
      for (int ny : {0, 1, 7, 19}) {
        for (int nz : {0, 1, 9, 19}) CHECK(setup.density_at(nx, ny, nz) == Approx(1000).epsilon(smeared));
      }
    }
  }
}

TEST_CASE("the wall's gradient is that of its density, everywhere", "[walls]") {
  for (int dimension : {2, 3}) {
    const Setup setup(dimension);
    const Vec3 places[] = {{0.02f, 0.5f, 0.5f}, {0.06f, 0.03f, 0.5f}, {0.97f, 0.01f, 0.03f}, {0.001f, 0.999f, 0.04f}};
    for (Vec3 x : places) {
      if (dimension == 2) x.z = 0;
      const Vec3 gradient = setup.walls.sum(x).gradient;
      for (int axis = 0; axis < dimension; ++axis) {
        const float e = 1e-3f;
        Vec3 above = x, below = x;
        above[axis] += e;
        below[axis] -= e;
        if (below[axis] < 0 || above[axis] > 1) continue;
        const double slope =
            (double{setup.walls.sum(above).gradient.w} - double{setup.walls.sum(below).gradient.w}) / (2 * double{e});
        CHECK(gradient[axis] == Approx(slope).epsilon(0.02).margin(20));
      }
    }
  }
}

TEST_CASE("walls add nothing out of reach, and stand for the missing neighbours within it", "[walls]") {
  const Setup setup(3);
  const WallSum far = setup.walls.sum({0.5f, 0.5f, 0.5f});
  CHECK(far.gradient.w == 0);
  CHECK(length(far.gradient) == 0);
  CHECK(far.neighbours == 0);
  // At the plane half of the ball of 4/3 pi 2^3 lattice points lies behind it.
  CHECK(setup.walls.sum({0.0f, 0.5f, 0.5f}).neighbours == Approx(16.755).epsilon(1e-3));
}

TEST_CASE("a wall holds what reaches its plane", "[walls]") {
  const Setup setup(3);
  Vec3 x{-0.01f, 0.5f, 1.2f}, v{-1, 2, 3};
  CHECK(setup.walls.hold(x, v));
  CHECK(x.x == 0);
  CHECK(x.z == 1);
  CHECK(v.x == 0);
  CHECK(v.y == 2);
  CHECK(v.z == 0);
  CHECK_FALSE(setup.walls.hold(x, v));
}

TEST_CASE("the wall's virial is its push times the distance, each face for itself", "[walls]") {
  const Setup setup(3);
  const WallSum one = setup.walls.sum({0.5f, 0.98f, 0.5f});
  CHECK(one.virial.y == Approx(double{one.gradient.y} * 0.02).epsilon(1e-4));
  CHECK(one.virial.x == 0);
  const WallSum corner = setup.walls.sum({0.03f, 0.98f, 0.04f});
  CHECK(corner.virial.x == Approx(-double{corner.gradient.x} * 0.03).epsilon(1e-4));
  CHECK(corner.virial.y == Approx(double{corner.gradient.y} * 0.02).epsilon(1e-4));
  CHECK(corner.virial.z == Approx(-double{corner.gradient.z} * 0.04).epsilon(1e-4));
}

TEST_CASE("a no-slip wall pulls towards its own velocity", "[walls]") {
  Domain domain;
  domain.max = {1, 1, 1};
  domain.walls[3] = {WallKind::no_slip, {2, 0, 0}};
  const Kernel kernel(d, 3);
  const Walls walls(domain, 3, kernel, d, 1000 / kernel.lattice_sum(d));
  CHECK(walls.any_no_slip());
  const Vec3 pull = walls.sum({0.5f, 0.97f, 0.5f}).friction;
  CHECK(pull.w > 0);
  CHECK(pull.x == Approx(2 * pull.w));
  CHECK(walls.sum({0.5f, 0.03f, 0.5f}).friction.w == 0);
}
