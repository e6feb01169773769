// How even the samples of every kind of surface are: least distance, widest hole, number.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "sim/scene/heightfield.h"
#include "sim/scene/mesh.h"
#include "sim/scene/sampling.h"
#include "sim/scene/shapes.h"
#include "tests/unit/sampling_measure.h"

using namespace curlew;
using namespace curlew::test;

namespace {

constexpr double pi = std::numbers::pi;

Domain wide_domain() {
  Domain domain;
  domain.min = {-5, -5, -5};
  domain.max = {5, 5, 5};
  return domain;
}

struct Bounds {
  double closest, hole, least_density, most_density;
};

void check_even(const std::string& name, const Evenness& even, Bounds bounds) {
  INFO(name << ": closest " << even.closest << ", hole " << even.hole << ", density " << even.density);
  if (std::getenv("CURLEW_PRINT_EVENNESS") != nullptr) {
    WARN(name << ": closest " << even.closest << ", hole " << even.hole << ", density " << even.density);
  }
  CHECK(even.closest >= bounds.closest);
  CHECK(even.hole <= bounds.hole);
  CHECK(even.density >= bounds.least_density);
  CHECK(even.density <= bounds.most_density);
}

Evenness measured(const Shape& shape, double d, const Domain& domain = wide_domain()) {
  const auto samples = sample_surface(shape, d, 3, domain);
  const TriangleMesh mesh = surface_mesh(shape, 3, domain);
  return evenness(samples, places_on(mesh, 0.15 * d), surface_area(mesh), d, 2);
}

Mesh mesh_of(TriangleMesh triangles) {
  Mesh mesh;
  mesh.mesh = std::make_shared<const TriangleMesh>(std::move(triangles));
  return mesh;
}

}  // namespace

TEST_CASE("boxes are sampled on even grids", "[sampling]") {
  for (const double edge : {1.0, 0.731, 0.3, 0.11}) {
    const Evenness even = measured(Box{{0, 0, 0}, {1, edge, 0.62}}, 0.1);
    check_even("box with an edge of " + std::to_string(edge), even, {0.6, 0.86, 0.8, 1.35});
  }
  const auto samples = sample_surface(Box{{0, 0, 0}, {1, 1, 1}}, 0.1, 3, wide_domain());
  CHECK(samples.size() == 11 * 11 * 11 - 9 * 9 * 9);  // edges and corners once
}

TEST_CASE("a thin box becomes one layer", "[sampling]") {
  const auto samples = sample_surface(Box{{0, 0, 0}, {1, 0.01, 1}}, 0.1, 3, wide_domain());
  CHECK(samples.size() == 11 * 11);
  for (const Vec3d& p : samples) CHECK(p.y == Approx(0.005));
}

TEST_CASE("spheres are sampled evenly", "[sampling]") {
  for (const double d : {0.5, 0.2, 0.08}) {
    const Evenness even = measured(Sphere{{0.3, -0.2, 0.1}, 1}, d);
    check_even("sphere of 1 m at " + std::to_string(d), even, {0.75, 0.86, 0.95, 1.05});
  }
}

TEST_CASE("cylinders are sampled evenly", "[sampling]") {
  for (const double d : {0.3, 0.1}) {
    check_even("upright cylinder at " + std::to_string(d), measured(Cylinder{{0, 0, 0}, {0, 1, 0}, 0.5}, d),
               {0.6, 0.9, 0.85, 1.25});
    check_even("leaning cylinder at " + std::to_string(d), measured(Cylinder{{0, 0, 0}, {1, 1, 0.5}, 0.2}, d),
               {0.6, 0.9, 0.8, 1.35});
  }
}

TEST_CASE("meshes are sampled evenly, their sharp edges first", "[sampling]") {
  const Domain domain = wide_domain();
  for (const double d : {0.2, 0.07}) {
    const Shape ball = mesh_of(surface_mesh(Sphere{{0, 0, 0}, 1}, 3, domain));
    check_even("sphere mesh at " + std::to_string(d), measured(ball, d), {0.6, 0.9, 0.8, 1.3});
    const Shape box = mesh_of(surface_mesh(Box{{0, 0, 0}, {1, 0.77, 0.5}}, 3, domain));
    check_even("box mesh at " + std::to_string(d), measured(box, d), {0.6, 0.9, 0.8, 1.35});
    const Shape rod = mesh_of(surface_mesh(Cylinder{{0, 0, 0}, {2, 0, 0}, 0.3}, 3, domain));  // long thin triangles
    check_even("cylinder mesh at " + std::to_string(d), measured(rod, d), {0.6, 0.9, 0.8, 1.35});
  }
  const Mesh rock =
      mesh_of(transformed(load_mesh(CURLEW_ASSETS_DIR "/meshes/rock.obj"), 0.5, {10, 20, 30}, {0.1, 0, 0}));
  check_even("rock", measured(rock, 0.05), {0.6, 0.9, 0.8, 1.35});
  // Every corner of a box is a sample: fluid finds no gap there.
  const auto samples = sample_surface(mesh_of(surface_mesh(Box{{0, 0, 0}, {1, 0.77, 0.5}}, 3, domain)), 0.1, 3, domain);
  for (const Vec3d& corner : {Vec3d{0, 0, 0}, Vec3d{1, 0.77, 0.5}, Vec3d{1, 0, 0.5}}) {
    CHECK(std::count(samples.begin(), samples.end(), corner) == 1);
  }
}

TEST_CASE("edges that leave the domain are sampled within it only", "[sampling]") {
  Domain domain;
  domain.max = {1, 1, 1};
  TriangleMesh needle;  // of so little area that its size is no reason to refuse it
  needle.vertices = {{-1e6, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.501}, {0.5, 0.501, 0.5}};
  needle.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const auto samples = sample_surface(mesh_of(needle), 1e-2, 3, domain);  // an edge is 1e8 samples long
  CHECK(samples.size() > 40);
  CHECK(samples.size() < 200);
}

TEST_CASE("planes are sampled inside the domain", "[sampling]") {
  Domain domain;
  domain.min = {0, 0, 0};
  domain.max = {1, 1, 1};
  const auto level = sample_surface(Plane{{0, 0.5, 0}, {0, 1, 0}}, 0.1, 3, domain);
  CHECK(level.size() == 11 * 11);
  const double d = 0.05;
  const auto slope = sample_surface(Plane{{0.5, 0.5, 0.5}, {0.3, 1, 0.2}}, d, 3, domain);
  std::vector<Vec3d> places;
  for (double x = 0; x <= 1; x += 0.01) {
    for (double z = 0; z <= 1; z += 0.01) places.push_back({x, 0.5 - 0.3 * (x - 0.5) - 0.2 * (z - 0.5), z});
  }
  check_even("leaning plane", evenness(slope, places, std::sqrt(1.13), d, 2), {0.9, 0.8, 0.9, 1.3});
  CHECK(sample_surface(Plane{{0, 5, 0}, {0, 1, 0}}, 0.1, 3, domain).empty());
}

TEST_CASE("heightfields are sampled on top and at free sides, not in walls", "[sampling]") {
  Heightfield field;
  field.formula = "0.3 + 0.1*sin(2*pi*x)*cos(2*pi*z)";
  field.min = {0, 0, 0};
  field.max = {1, 1, 1};
  load_heights(field, "", 3, "test");
  Domain domain;
  domain.min = {0, 0, 0};
  domain.max = {1, 1, 1};
  const double d = 0.05;
  const auto samples = sample_surface(field, d, 3, domain);
  std::vector<Vec3d> places;
  for (double x = 0; x <= 1; x += 0.01) {
    for (double z = 0; z <= 1; z += 0.01) places.push_back({x, height_at(field, x, z), z});
  }
  check_even("heightfield", evenness(samples, places, 1.09, d, 2), {0.6, 0.9, 0.8, 1.35});
  for (const Vec3d& p : samples) CHECK(p.y == Approx(height_at(field, p.x, p.z)).margin(1e-3));

  field.max.x = 0.5;  // now its side at x = 0.5 stands free
  const auto free_side = sample_surface(field, d, 3, domain);
  CHECK(std::count_if(free_side.begin(), free_side.end(),
                      [](Vec3d p) { return std::abs(p.x - 0.5) < 1e-12 && p.y < 0.2; }) > 40);
}

TEST_CASE("outlines in 2D are sampled evenly", "[sampling]") {
  const double d = 0.05;
  const auto close_and_even = [&](const Shape& shape, double perimeter) {
    const auto samples = sample_surface(shape, d, 2, wide_domain());
    CHECK(static_cast<double>(samples.size()) * d / perimeter == Approx(1).margin(0.1));
    const Cloud cloud(samples, 3 * d);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double nearest = cloud.nearest(samples[i], i) / d;
      CHECK((nearest > 0.7 && nearest < 1.1));
      CHECK(samples[i].z == 0);
      CHECK(std::abs(ShapeProbe(shape, 2).distance(samples[i], 1)) < 1e-12);
    }
  };
  close_and_even(Box{{0, 0, 0}, {1, 0.62, 0}}, 3.24);
  close_and_even(Sphere{{0, 0, 0}, 0.5}, pi);
  close_and_even(Cylinder{{0, 0, 0}, {1, 0.5, 0}, 0.2}, 2 * std::hypot(1, 0.5) + 0.4 * pi);
  close_and_even(Plane{{0, 0, 0}, {0.1, 1, 0}}, 10 * std::hypot(1, 0.1));
  Heightfield field;
  field.formula = "0.5 + 0.2*sin(3*x)";
  field.min = {0, 0, 0};
  field.max = {2, 1, 0};
  load_heights(field, "", 2, "test");
  const auto samples = sample_surface(field, d, 2, wide_domain());
  const Evenness even = evenness(samples, samples, 2 + 2.09 + 0.5 + 0.444, d, 1);
  check_even("heightfield in 2D", even, {0.6, 0, 0.9, 1.1});
}

TEST_CASE("samples beyond the domain are left out, and periodic seams close evenly", "[sampling]") {
  Domain domain;
  domain.min = {0, 0, 0};
  domain.max = {1, 1, 1};
  const double d = 0.05;
  const auto huge = sample_surface(Box{{-1000.025, -1e3, -1000.025}, {999.975, 0.3, 999.975}}, d, 3, domain);
  CHECK(huge.size() == 24 * 24);  // two spacings beyond the domain on either side
  for (const Vec3d& p : huge) CHECK(p.y == 0.3);
  domain.periodic = {true, false, true};
  const auto seam = sample_surface(Plane{{0, 0.3, 0}, {0, 1, 0}}, d, 3, domain);
  CHECK(seam.size() == 20 * 20);
}

TEST_CASE("surface samples are the same every time", "[sampling]") {
  const Shape rock = mesh_of(load_mesh(CURLEW_ASSETS_DIR "/meshes/rock.obj"));
  CHECK(sample_surface(rock, 0.1, 3, wide_domain()) == sample_surface(rock, 0.1, 3, wide_domain()));
}
