// The surface made of vortex sub-particles.
#include "sim/surface/sub_sources.h"

#include <omp.h>

#include <cstring>
#include <numbers>
#include <numeric>

#include "tests/unit/surface_clouds.h"

using namespace curlew;
using namespace curlew::test;

namespace {

constexpr double radius = 0.02;

// Particles of the same level.
struct Split {
  std::vector<Vec3> particles, sub_particles;
  std::vector<std::uint32_t> id;

  Split(std::vector<Vec3> places, float level) : particles(std::move(places)), id(particles.size()) {
    std::iota(id.begin(), id.end(), 0u);
    for (const std::uint32_t i : id) {
      const auto turn = [&](float by) { return std::fmod(by * static_cast<float>(i), 1.0f); };
      Vec3 state{turn(0.37f), turn(0.71f), turn(0.13f)};
      state.w = level;
      sub_particles.push_back(state);
    }
  }
  SurfaceParticles all() const { return {particles, {}, {}, sub_particles, id, 0.3}; }
};

// The integral of the level set's field, without the iso value, over one over its value for a particle as a whole.
double integral(float level) {
  Scene scene = scene_with(radius);
  const Split split({{0.011f, -0.003f, 0.007f}}, level);
  std::vector<Vec3> whole = split.particles;
  whole[0].w = 1;
  SubSources sources;
  sources.split(whole, {split.particles, split.id, split.sub_particles, 0.3, radius});
  std::vector<SourceShape> shapes;
  const double reach = 4 * radius, cell = 0.5 * radius;
  for (int l = 0; l <= most_sub_levels; ++l) shapes.push_back(round_shape(sub_particle_share(l) * reach));
  LevelSet level_set;
  level_set.build({sources.sources(), shapes, sources.kind(), scene.spacing()}, scene.domain, cell, 0.5);
  double sum = 0;
  for (std::size_t b = 0; b < level_set.bricks().size(); ++b) {
    for (int k = 0; k < LevelSet::points; ++k)
      sum += static_cast<double>(level_set.values(b)[k] - level_set.value_outside());
  }
  const Vec3d c = level_set.cell();
  return sum * c.x * c.y * c.z / (64 * std::numbers::pi / 315 * std::pow(reach, 3));
}

double roughness(const SurfaceMesh& mesh) {
  double sum = 0, square = 0, number = 0;
  for (const Vec3& p : mesh.position) {
    if (p.y < -0.2f || std::abs(p.x) > 0.8f || std::abs(p.z) > 0.8f) continue;
    number += 1;
    sum += static_cast<double>(p.y);
    square += static_cast<double>(p.y) * static_cast<double>(p.y);
  }
  return std::sqrt(square / number - sum / number * sum / number);
}

}  // namespace

TEST_CASE("the field of a particle has the same integral on every level, and between levels") {
  for (const float level : {0.0f, 0.3f, 1.0f, 1.5f, 2.0f, 2.8f, 3.0f}) {
    CAPTURE(level);
    CHECK(integral(level) == Approx(1).epsilon(0.01));
  }
}

TEST_CASE("level 0 gives the surface of the particles to the bit") {
  const Scene scene = scene_with(radius);
  const Split split(lattice(scene, ball(0.4)), 0);
  SurfaceMaker maker;
  const SurfaceMesh with = maker.make(split.all(), scene), without = surface(scene, split.particles);
  REQUIRE(with.position.size() == without.position.size());
  CHECK(std::memcmp(with.position.data(), without.position.data(), with.position.size() * sizeof(Vec3)) == 0);
}

TEST_CASE("split water has a closed surface of nearly its volume, and a livelier one") {
  const Scene scene = scene_with(radius);
  const auto drop = lattice(scene, ball(0.4)), pool = lattice(scene, box({-1, -1, -1}, {1, 0, 1}));
  SurfaceMaker maker;
  double last = 0;
  for (const float level : {0.0f, 1.0f, 2.5f, 3.0f}) {
    CAPTURE(level);
    const SurfaceMesh mesh = maker.make(Split(drop, level).all(), scene);
    check_closed(mesh, scene);
    CHECK(enclosed_volume(mesh) ==
          Approx(static_cast<double>(drop.size()) * std::pow(scene.spacing(), 3)).epsilon(0.06));
    const double rough = roughness(maker.make(Split(pool, level).all(), scene));
    CHECK(rough > last);
    last = rough;
  }
  CHECK(last > 2 * roughness(maker.make(Split(pool, 0).all(), scene)));
}

TEST_CASE("vertices of split water have the velocity of their particles") {
  const Scene scene = scene_with(radius);
  const Split split(lattice(scene, ball(0.4)), 3);
  const std::vector<Vec3> velocity(split.particles.size(), Vec3{1, 2, 3});
  SurfaceParticles particles = split.all();
  particles.velocity = velocity;
  SurfaceMaker maker;
  const SurfaceMesh& mesh = maker.make(particles, scene);
  REQUIRE(mesh.velocity.size() == mesh.position.size());
  for (const Vec3& v : mesh.velocity) CHECK(length(v - Vec3{1, 2, 3}) < 1e-4f);
}

TEST_CASE("split water has the same surface on 1 and 3 threads") {
  const Scene scene = scene_with(radius);
  const Split split(lattice(scene, ball(0.4)), 1.4f);
  const int threads = omp_get_max_threads();
  std::vector<SurfaceMesh> meshes;
  for (const int n : {1, 3}) {
    omp_set_num_threads(n);
    meshes.push_back(SurfaceMaker().make(split.all(), scene));
  }
  omp_set_num_threads(threads);
  REQUIRE(meshes[0].position.size() == meshes[1].position.size());
  const auto bytes = meshes[0].position.size() * sizeof(Vec3);
  CHECK(std::memcmp(meshes[0].position.data(), meshes[1].position.data(), bytes) == 0);
}

TEST_CASE("levels that no pass would make, from a damaged file, are taken for the nearest") {
  const Scene scene = scene_with(radius);
  for (const float level : {-1.0f, NAN, 1e9f, INFINITY}) {
    const Split split(lattice(scene, ball(0.2)), level);
    SurfaceMaker maker;
    check_closed(maker.make(split.all(), scene), scene);
    const SplitParticles parts = split_particles({split.particles, split.id, split.sub_particles, 0, radius});
    CHECK(parts.position.size() == split.particles.size() * (level > 0 ? 8 : 1));
  }
}
