// Inside, distance, bounds, volume and surface of every shape.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <random>

#include "sim/scene/heightfield.h"
#include "sim/scene/mesh.h"
#include "sim/scene/shapes.h"

using namespace curlew;

namespace {

constexpr double pi = std::numbers::pi;

Domain domain_of(Vec3d min, Vec3d max) {
  Domain domain;
  domain.min = min;
  domain.max = max;
  return domain;
}

Mesh mesh_of(TriangleMesh triangles) {
  Mesh mesh;
  mesh.mesh = std::make_shared<const TriangleMesh>(std::move(triangles));
  return mesh;
}

Heightfield hills(int dimension) {
  Heightfield field;
  field.formula = dimension == 3 ? "0.5 + 0.2*sin(2*x)*cos(3*z)" : "0.5 + 0.2*sin(2*x)";
  field.min = {-1, 0, dimension == 3 ? -1.0 : 0.0};
  field.max = {1, 1, dimension == 3 ? 1.0 : 0.0};
  load_heights(field, "", dimension, "test");
  return field;
}

// Vertices at one place become one, so that edges can be counted.
TriangleMesh joined(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::map<std::array<long, 3>, std::uint32_t> known;
  for (auto triangle : mesh.triangles) {
    for (std::uint32_t& index : triangle) {
      const Vec3d p = mesh.vertices[index];
      const auto round = [](double x) { return std::lround(x * 1e9); };
      const auto [entry, is_new] = known.try_emplace({round(p.x), round(p.y), round(p.z)}, result.vertices.size());
      if (is_new) result.vertices.push_back(p);
      index = entry->second;
    }
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace

TEST_CASE("signed distances are exact", "[shapes]") {
  const auto distance = [](const Shape& shape, Vec3d p, int dimension = 3) {
    return ShapeProbe(shape, dimension).distance(p, 10);
  };
  const Box box{{0, 0, 0}, {2, 1, 1}};
  CHECK(distance(box, {1, 0.4, 0.5}) == Approx(-0.4));
  CHECK(distance(box, {3, 0.5, 0.5}) == Approx(1));
  CHECK(distance(box, {5, 5, 0.5}) == Approx(5));
  CHECK(distance(box, {5, 5, 99}, 2) == Approx(5));
  CHECK(distance(Sphere{{1, 1, 1}, 0.5}, {1, 1, 3}) == Approx(1.5));
  CHECK(distance(Sphere{{1, 1, 0}, 0.5}, {1, 1, 3}, 2) == Approx(-0.5));
  const Cylinder cylinder{{0, 0, 0}, {0, 2, 0}, 0.5};
  CHECK(distance(cylinder, {0.4, 1, 0}) == Approx(-0.1));
  CHECK(distance(cylinder, {0, 1.95, 0}) == Approx(-0.05));
  CHECK(distance(cylinder, {3.5, 6, 0}) == Approx(5));     // 3 beyond the side, 4 beyond the end
  CHECK(distance(cylinder, {0, 3, 0}, 2) == Approx(0.5));  // round ends in 2D
  CHECK(distance(cylinder, {0.3, 2.4, 0}, 2) == Approx(0).margin(1e-12));
  CHECK(distance(Plane{{0, 1, 0}, {0, 3, 0}}, {7, 1.5, 7}) == Approx(0.5));
  CHECK(distance(Plane{{0, 1, 0}, {1, 1, 0}}, {0, 0, 0}) == Approx(-std::sqrt(0.5)));
  CHECK(inside(box, {1, 0.5, 0.5}, 3));
  CHECK_FALSE(inside(box, {1, 1.5, 0.5}, 3));
}

TEST_CASE("heightfields fill their box up to the height", "[shapes]") {
  const Shape shape = hills(3);
  const Heightfield& field = std::get<Heightfield>(shape);
  const ShapeProbe probe(shape, 3);
  for (double x = -0.9; x < 1; x += 0.3) {
    for (double z = -0.9; z < 1; z += 0.3) {
      const double height = 0.5 + 0.2 * std::sin(2 * x) * std::cos(3 * z);
      CHECK(height_at(field, x, z) == Approx(height).margin(1e-4));
      CHECK(probe.inside({x, height - 0.01, z}));
      CHECK_FALSE(probe.inside({x, height + 0.01, z}));
    }
  }
  CHECK_FALSE(probe.inside({1.1, 0.1, 0}));
  CHECK_FALSE(probe.inside({0, -0.1, 0}));
  CHECK(probe.distance({0, 0.4, 0}, 1) == Approx(-0.1 / std::sqrt(1 + 0.16)).margin(1e-3));  // slope 0.4
  CHECK(inside(hills(2), {0.5, 0.6, 99}, 2));
}

TEST_CASE("the mesh index agrees with the analytic shape", "[shapes]") {
  const Domain domain = domain_of({-3, -3, -3}, {3, 3, 3});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.2, 1.2);
  for (const Shape& shape : {Shape(Box{{-1, -0.5, -0.25}, {1, 0.5, 0.75}}), Shape(Sphere{{0, 0, 0}, 1}),
                             Shape(Cylinder{{-0.5, -0.5, 0}, {0.5, 0.5, 0.3}, 0.5})}) {
    INFO(shape_name(shape));
    const Mesh mesh = mesh_of(surface_mesh(shape, 3, domain));
    const Shape as_mesh = mesh;
    const ShapeProbe exact(shape, 3), index(as_mesh, 3);
    for (int i = 0; i < 4000; ++i) {
      const Vec3d p{any(random), any(random), any(random)};
      const double distance = exact.distance(p, 9);
      if (std::abs(distance) < 3e-3) continue;  // between the round shape and its facets
      REQUIRE(index.inside(p) == (distance < 0));
      REQUIRE(index.distance(p, 0.5) == Approx(std::clamp(distance, -0.5, 0.5)).margin(3e-3));
    }
  }
}

TEST_CASE("points in line with edges and corners are still sorted right", "[shapes]") {
  const Domain domain = domain_of({-3, -3, -3}, {3, 3, 3});
  const Shape cube = mesh_of(surface_mesh(Box{{0, 0, 0}, {1, 1, 1}}, 3, domain));
  const Shape exact = Box{{0, 0, 0}, {1, 1, 1}};
  const ShapeProbe probe(cube, 3), exact_probe(exact, 3);
  for (int i = -5; i <= 25; ++i) {
    for (int j = -5; j <= 25; ++j) {
      for (int k = -5; k <= 25; ++k) {
        const Vec3d p{i / 20.0, j / 20.0, k / 20.0};  // many right below the diagonals of the faces, many on them
        const double distance = exact_probe.distance(p, 1);
        if (std::abs(distance) > 1e-9) REQUIRE(probe.inside(p) == (distance < 0));
      }
    }
  }
}

TEST_CASE("volumes", "[shapes]") {
  const Domain wide = domain_of({-9, -9, -9}, {9, 9, 9}), half = domain_of({0, -9, -9}, {9, 9, 9});
  CHECK(volume(Box{{-1, -1, -1}, {1, 1, 1}}, 3, half) == Approx(4));
  CHECK(volume(Box{{-1, -1, 0}, {1, 1, 0}}, 2, domain_of({0, -9, 0}, {9, 9, 0})) == Approx(2));
  CHECK(volume(Box{{10, 0, 0}, {11, 1, 1}}, 3, wide) == 0);
  CHECK(volume(Sphere{{0, 0, 0}, 1}, 3, wide) == Approx(4 * pi / 3));
  CHECK(volume(Sphere{{0, 0, 0}, 1}, 3, half) == Approx(2 * pi / 3).epsilon(0.01));
  CHECK(volume(Cylinder{{0, 0, 0}, {0, 2, 0}, 1}, 3, wide) == Approx(2 * pi));
  CHECK(volume(Cylinder{{0, 0, 0}, {0, 2, 0}, 1}, 2, domain_of({-9, -9, 0}, {9, 9, 0})) == Approx(4 + pi));
  CHECK(volume(Plane{{0, 0, 0}, {0, 1, 0}}, 3, wide) == Approx(18 * 18 * 9));
  CHECK(volume(mesh_of(surface_mesh(Box{{0, 0, 0}, {1, 2, 3}}, 3, wide)), 3, wide) == Approx(6));
  CHECK(volume(hills(3), 3, wide) == Approx(2.0).epsilon(0.01));
}

TEST_CASE("surface meshes are closed and face outwards", "[shapes]") {
  const Domain domain = domain_of({-1, 0, -1}, {1, 2, 1}), flat = domain_of({-1, 0, 0}, {1, 2, 0});
  const auto check = [](const TriangleMesh& mesh, double expected, double tolerance) {
    CHECK_NOTHROW(require_closed(joined(mesh), "mesh"));
    CHECK(signed_volume(mesh) == Approx(expected).epsilon(tolerance));
  };
  check(surface_mesh(Box{{0, 0, 0}, {1, 2, 3}}, 3, domain), 6, 1e-12);
  check(surface_mesh(Sphere{{5, 5, 5}, 1}, 3, domain), 4 * pi / 3, 0.01);
  check(surface_mesh(Cylinder{{0, 0, 0}, {1, 2, 2}, 0.5}, 3, domain), 3 * pi / 4, 0.01);
  check(surface_mesh(Cylinder{{0, 0, 0}, {2, 0, 0}, 0.5}, 3, domain), 2 * pi / 4, 0.01);
  check(surface_mesh(Plane{{0, 1, 0}, {0, 1, 0}}, 3, domain), 4, 1e-9);
  check(surface_mesh(Plane{{0, 1, 0}, {0.3, -1, 0.2}}, 3, domain), 4, 1e-9);
  check(surface_mesh(Plane{{0, 5, 0}, {0, 1, 0}}, 3, domain), 8, 1e-9);  // all of the domain
  check(surface_mesh(hills(3), 3, domain), 2, 0.01);
  const double thick = 0.02;  // 1 % of the domain
  check(surface_mesh(Box{{0, 0, 0}, {1, 2, 0}}, 2, flat), 2 * thick, 1e-9);
  check(surface_mesh(Sphere{{0, 0, 0}, 1}, 2, flat), pi * thick, 0.01);
  check(surface_mesh(Cylinder{{0, 0, 0}, {0.6, 0.8, 0}, 0.5}, 2, flat), (1 + pi / 4) * thick, 0.01);
  check(surface_mesh(Plane{{0, 1, 0}, {0, 1, 0}}, 2, flat), 2 * thick, 1e-9);
  check(surface_mesh(hills(2), 2, flat), 1 * thick, 0.02);
}

TEST_CASE("bounds are tight and cut to the domain", "[shapes]") {
  const Domain domain = domain_of({0, 0, 0}, {2, 2, 2});
  const auto check = [&](const Shape& shape, Vec3d min, Vec3d max) {
    const Box box = bounds(shape, 3, domain);
    CHECK(length(box.min - min) < 1e-12);
    CHECK(length(box.max - max) < 1e-12);
  };
  check(Sphere{{1, 1, 0.25}, 0.5}, {0.5, 0.5, 0}, {1.5, 1.5, 0.75});
  check(Cylinder{{1, 0.5, 1}, {1, 1.5, 1}, 0.5}, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  check(Plane{{1, 1, 1}, {1, 0, 0}}, {0, 0, 0}, {2, 2, 2});
}
