// Sources in the shape of their surroundings.
#include "sim/surface/anisotropy.h"

#include <omp.h>

#include <cstring>
#include <numbers>

#include "tests/unit/surface_clouds.h"

using namespace curlew;
using namespace curlew::test;

namespace {

struct Shaped {
  std::vector<Vec3> sources;
  std::vector<SourceShape> shapes;
};

constexpr double reach = 0.08;

Shaped shaped(const Scene& scene, std::vector<Vec3> particles) {
  Shaped s{std::move(particles), {}};
  for (Vec3& p : s.sources) p.w = 1;
  ShapeFinder().run(s.sources, scene.domain, scene.spacing(), reach, s.shapes);
  return s;
}

// The longest over the shortest reach along the axes of space.
float flatness(const SourceShape& shape) {
  const Vec3 r = shape.reach;
  return std::max({r.x, r.y, r.z}) / std::min({r.x, r.y, r.z});
}

// 2 for a ball, less by 2 for each hole through it.
std::int64_t euler_characteristic(const SurfaceMesh& mesh) {
  const auto vertices = static_cast<std::int64_t>(mesh.position.size()),
             triangles = static_cast<std::int64_t>(mesh.triangles.size());
  return vertices - triangles / 2;
}

}  // namespace

TEST_CASE("sources are round within water and at walls, flat at its surface and in sheets, and keep their integral") {
  const Scene scene = scene_with();  // spacing 0.04, a tank from -1 to 1
  const Shaped pool = shaped(scene, lattice(scene, box({-1, -1, -1}, {1, 0, 1}), 0.1));
  for (std::size_t i = 0; i < pool.sources.size(); i += 7) {
    const Vec3 p = pool.sources[i];
    const SourceShape& shape = pool.shapes[i];
    CAPTURE(p.x, p.y, p.z, shape.reach.x, shape.reach.y, shape.reach.z);
    // Three spacings below the surface, also beside walls, edges and corners.
    if (p.y < -0.14f) CHECK(flatness(shape) < 1.15f);
    if (p.y > -0.04f) {
      CHECK(shape.reach.y < 0.8f * std::min(shape.reach.x, shape.reach.z));
      CHECK(shape.reach.y > 0.4f * std::min(shape.reach.x, shape.reach.z));
    }
    // An ellipsoid's volume goes with the root of its matrix' inverse determinant.
    const Vec3 d = shape.diagonal, m = shape.mixed;
    const double determinant = static_cast<double>(d.x) * (d.y * d.z - m.x * m.x) - m.z * (m.z * d.z - m.x * m.y) +
                               m.y * (m.z * m.x - d.y * m.y);
    CHECK(static_cast<double>(p.w) / std::sqrt(determinant) == Approx(reach * reach * reach).epsilon(1e-3));
  }

  const Shaped sheet = shaped(scene, lattice(scene, box({-0.6, 0, -0.6}, {0.6, 0.04, 0.6}), 0.1));
  for (std::size_t i = 0; i < sheet.sources.size(); ++i) {
    if (std::hypot(sheet.sources[i].x, sheet.sources[i].z) > 0.4f) continue;
    CHECK(sheet.shapes[i].reach.y == Approx(0.25f * reach).epsilon(0.1));
  }
  const Shaped alone = shaped(scene, {{0, 0, 0}, {0.5f, 0, 0}, {0.53f, 0, 0}});
  for (const SourceShape& shape : alone.shapes) CHECK(flatness(shape) == 1);
}

TEST_CASE("a tilted sheet has tilted sources") {
  const Scene scene = scene_with();
  std::vector<Vec3> particles;
  for (int i = -15; i <= 15; ++i) {
    for (int k = -15; k <= 15; ++k) {
      const auto u = static_cast<float>(0.04 * i), v = static_cast<float>(0.04 * k), half = std::sqrt(0.5f);
      particles.push_back({half * u, half * u, v});  // normal (1, -1, 0) / root 2
    }
  }
  const Shaped sheet = shaped(scene, particles);
  const SourceShape& shape = sheet.shapes[particles.size() / 2];
  const Vec3 n{std::sqrt(0.5f), -std::sqrt(0.5f), 0}, t{std::sqrt(0.5f), std::sqrt(0.5f), 0};
  const auto form = [&](Vec3 x) {
    return shape.diagonal.x * x.x * x.x + shape.diagonal.y * x.y * x.y + shape.diagonal.z * x.z * x.z +
           2 * (shape.mixed.x * x.y * x.z + shape.mixed.y * x.z * x.x + shape.mixed.z * x.x * x.y);
  };
  CHECK(1 / std::sqrt(form(n)) == Approx(0.25 * reach).epsilon(1e-3));
  CHECK(1 / std::sqrt(form(t)) == Approx(reach).epsilon(1e-2));
}

TEST_CASE("an anisotropic surface is closed and keeps the volume, and a torn sheet has fewer holes in it") {
  Scene scene = scene_with();
  scene.parameters.surface.anisotropic = true;
  const auto drop = lattice(scene, ball(0.5));
  const SurfaceMesh mesh = surface(scene, drop);
  check_closed(mesh, scene);
  const double of_particles = static_cast<double>(drop.size()) * std::pow(scene.spacing(), 3);
  CAPTURE(enclosed_volume(mesh) / of_particles);
  CHECK(enclosed_volume(mesh) == Approx(of_particles).epsilon(0.03));

  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(0, 1);
  const Inside flat = box({-0.6, 0, -0.6}, {0.6, 0.04, 0.6});
  const auto sheet = lattice(
      scene, [&](Vec3d p) { return flat(p) && draw(random) < 0.75; }, 0.3);
  const auto density = densities(scene, sheet);
  const SurfaceMesh whole = surface(scene, sheet, density);
  scene.parameters.surface.anisotropic = false;
  const SurfaceMesh torn = surface(scene, sheet, density);
  CAPTURE(euler_characteristic(whole), euler_characteristic(torn));
  CHECK(euler_characteristic(whole) > euler_characteristic(torn) + 10);
}

TEST_CASE("an anisotropic surface has the same bits on 1 and 3 threads") {
  Scene scene = scene_with();
  scene.parameters.surface.anisotropic = true;
  const auto particles = lattice(scene, [](Vec3d p) { return length(p) < 0.4 || p.y < -0.8; });
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const SurfaceMesh one = surface(scene, particles);
  omp_set_num_threads(3);
  const SurfaceMesh three = surface(scene, particles);
  omp_set_num_threads(threads);
  REQUIRE(one.position.size() == three.position.size());
  CHECK(std::memcmp(one.position.data(), three.position.data(), one.position.size() * sizeof(Vec3)) == 0);
}
