// Neighbour lists against brute force, on random and on nasty clouds.
#include "sim/sph/neighbours.h"

#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

using namespace curlew;

namespace {

constexpr double support = 0.1;

Domain box(double length, bool periodic) {
  Domain domain;
  domain.max = {length, length, length};
  domain.periodic = {periodic, periodic, periodic};
  return domain;
}

std::vector<Vec3> random_cloud(std::size_t n, double length, int dimension, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(0, static_cast<float>(length));
  std::vector<Vec3> cloud(n);
  for (Vec3& x : cloud) {
    x.x = place(random);
    x.y = place(random);
    x.z = dimension == 3 ? place(random) : 0;
  }
  return cloud;
}

double distance(Vec3 a, Vec3 b, const CellShape& shape) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double x = double{a[axis]} - double{b[axis]};
    const double period = shape.period[axis];
    if (period > 0) x -= period * std::nearbyint(x / period);
    squared += x * x;
  }
  return std::sqrt(squared);
}

// Sorts the cloud, builds lists, and checks each against all pairs. Pairs at the very edge of the support, where the
// kernel is zero, may be in or out by round-off.
void check_against_brute_force(const Domain& domain, int dimension, const std::vector<Vec3>& cloud) {
  const CellShape shape = make_cell_shape(domain, dimension, support);
  Grid grid;
  std::vector<std::uint32_t> order;
  grid.build(shape, cloud, order);
  REQUIRE(order.size() == cloud.size());
  std::vector<Vec3> sorted;
  for (std::uint32_t k : order) sorted.push_back(cloud[k]);
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < order.size(); ++k) REQUIRE(order[k] == k);

  NeighbourLists lists;
  lists.build(shape, grid, sorted, support);
  std::size_t wrong = 0, pairs = 0;
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    const std::vector<std::uint32_t> got(lists.begin(i), lists.begin(i) + lists.count(i));
    pairs += got.size();
    for (std::size_t k = 0; k < lists.groups(i) * 8; ++k) {
      if (k >= lists.count(i)) wrong += lists.begin(i)[k] != i;  // padding is the particle itself
    }
    for (std::uint32_t j = 0; j < sorted.size(); ++j) {
      const double r = distance(sorted[i], sorted[j], shape);
      if (std::abs(r - support) < 1e-6) continue;
      const bool expected = i != j && r < support;
      wrong += expected != (std::find(got.begin(), got.end(), j) != got.end());
    }
  }
  CHECK(wrong == 0);
  CHECK(pairs == lists.pairs());
}

}  // namespace

TEST_CASE("neighbours of random clouds equal brute force", "[neighbours]") {
  for (bool periodic : {false, true}) {
    check_against_brute_force(box(1, periodic), 3, random_cloud(2000, 1, 3, 1));
    check_against_brute_force(box(0.43, periodic), 3, random_cloud(500, 0.43, 3, 2));
    check_against_brute_force(box(1, periodic), 2, random_cloud(1000, 1, 2, 3));
  }
}

TEST_CASE("neighbours of nasty clouds equal brute force", "[neighbours]") {
  const Domain domain = box(1, false);
  SECTION("one particle") { check_against_brute_force(domain, 3, {{0.5f, 0.5f, 0.5f}}); }
  SECTION("all in one place") { check_against_brute_force(domain, 3, std::vector<Vec3>(300, Vec3{0.3f, 0.3f, 0.3f})); }
  SECTION("far outliers on every side, and beyond any grid") {
    auto cloud = random_cloud(500, 1, 3, 4);
    for (float far : {10.0f, 1e3f, 1e9f, 3e37f}) {
      cloud.push_back({far, 0, 0});
      cloud.push_back({0, -far, far});
      cloud.push_back({-far, -far, -far});
      cloud.push_back({-far, -far, -far});
    }
    check_against_brute_force(domain, 3, cloud);
  }
  SECTION("a lattice whose points lie on cell faces") {
    std::vector<Vec3> cloud;
    for (int k = 0; k < 1000; ++k) {
      cloud.push_back({static_cast<float>(k % 10) * 0.1f, static_cast<float>(k / 10 % 10) * 0.1f,
                       static_cast<float>(k / 100) * 0.1f});
    }
    check_against_brute_force(domain, 3, cloud);
    check_against_brute_force(box(1, true), 3, cloud);
  }
  SECTION("on the seam of a periodic box") {
    auto cloud = random_cloud(400, 1, 3, 5);
    for (std::size_t k = 0; k < cloud.size(); ++k)
      cloud[k][static_cast<int>(k % 3)] = k % 2 ? 0.0f : std::nextafter(1.0f, 0.0f);
    check_against_brute_force(box(1, true), 3, cloud);
  }
  SECTION("no particle at all") {
    const CellShape shape = make_cell_shape(domain, 3, support);
    Grid grid;
    std::vector<std::uint32_t> order;
    grid.build(shape, {}, order);
    NeighbourLists lists;
    lists.build(shape, grid, {}, support);
    CHECK(lists.pairs() == 0);
  }
}

TEST_CASE("positions that are not numbers have no neighbours and break nothing", "[neighbours]") {
  auto cloud = random_cloud(200, 1, 3, 6);
  cloud[17].x = std::nanf("");
  cloud[18] = {INFINITY, -INFINITY, 0};
  const CellShape shape = make_cell_shape(box(1, false), 3, support);
  Grid grid;
  std::vector<std::uint32_t> order;
  grid.build(shape, cloud, order);
  std::vector<Vec3> sorted;
  for (std::uint32_t k : order) sorted.push_back(cloud[k]);
  NeighbourLists lists;
  lists.build(shape, grid, sorted, support);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (!std::isfinite(sorted[i].x)) CHECK(lists.count(i) == 0);
  }
}

TEST_CASE("the sort is stable and the same on any number of threads", "[neighbours][threads]") {
  const auto cloud = random_cloud(50000, 3, 3, 7);
  const CellShape shape = make_cell_shape(box(3, false), 3, support);
  const int before = omp_get_max_threads();
  std::vector<std::uint32_t> reference;
  for (int threads : {1, 2, 4, 8}) {
    omp_set_num_threads(threads);
    Grid grid;
    std::vector<std::uint32_t> order;
    grid.build(shape, cloud, order);
    for (std::size_t cell = 0; cell < grid.cell_number(); ++cell) {
      REQUIRE(std::is_sorted(order.begin() + grid.begin(cell), order.begin() + grid.end(cell)));
    }
    if (reference.empty()) reference = order;
    CHECK(order == reference);
  }
  omp_set_num_threads(before);
}
