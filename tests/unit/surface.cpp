// The surface of the water as a mesh: closed whatever the water does, and where theory says.
#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "sim/core/error.h"
#include "sim/surface/marching_cubes.h"
#include "tests/unit/surface_clouds.h"

using namespace curlew;
using namespace curlew::test;

namespace {

struct Cloud {
  const char* name;
  Inside inside;
};

}  // namespace

TEST_CASE("the table of marching cubes covers each case, and its triangles cross no face") {
  const auto& table = marching_cubes_table();
  const auto on_face = [](int edge, int axis, bool high) {
    return edge_axis(edge) != axis && ((edge_corner(edge) & axis_bit(axis)) != 0) == high;
  };
  for (int inside = 0; inside < 256; ++inside) {
    const CellTriangles& cell = table[static_cast<std::size_t>(inside)];
    CHECK((cell.count == 0) == (inside == 0 || inside == 255));
    // A side that is used once lies on a face, one that is used twice lies within the cell.
    std::map<std::pair<int, int>, int> sides;
    std::array<bool, 12> used{};
    for (int t = 0; t < cell.count; ++t) {
      const auto& e = cell.edges[static_cast<std::size_t>(t)];
      for (std::size_t k = 0; k < 3; ++k) {
        ++sides[{e[k], e[(k + 1) % 3]}];
        used[e[k]] = true;
      }
    }
    for (const auto& [side, times] : sides) {
      CHECK(times == 1);
      bool shared = false;
      for (int face = 0; face < 6; ++face)
        shared = shared || (on_face(side.first, face / 2, face % 2) && on_face(side.second, face / 2, face % 2));
      CHECK(shared != sides.contains({side.second, side.first}));
    }
    for (int edge = 0; edge < 12; ++edge) {
      const int low = edge_corner(edge), high = low | axis_bit(edge_axis(edge));
      CHECK(used[static_cast<std::size_t>(edge)] == ((inside >> low & 1) != (inside >> high & 1)));
    }
  }
}

TEST_CASE("the volume of a ball of water, and better with resolution") {
  double last = 1;
  for (const double radius : {0.04, 0.02, 0.01}) {
    Scene scene = scene_with(radius);
    const double ball_radius = 0.4;
    const auto particles = lattice(scene, ball(ball_radius), 0);
    const SurfaceMesh mesh = surface(scene, particles);
    const double exact = 4.0 / 3 * std::numbers::pi * std::pow(ball_radius, 3);
    const double of_particles = static_cast<double>(particles.size()) * std::pow(scene.spacing(), 3);
    const double error = std::abs(enclosed_volume(mesh) / of_particles - 1);
    CAPTURE(radius, particles.size(), error);
    CHECK(std::abs(enclosed_volume(mesh) / exact - 1) < 0.02);
    CHECK(std::abs(area(mesh) / (4 * std::numbers::pi * ball_radius * ball_radius) - 1) < 0.08);
    CHECK(error < 0.6 * last);
    last = error;
    double far = 0;
    for (const Vec3& p : mesh.position) far = std::max(far, std::abs(static_cast<double>(length(p)) - ball_radius));
    CHECK(far < 0.6 * scene.spacing());
  }
}

TEST_CASE("a lone particle is a drop of its own volume, and so is a row of them") {
  Scene scene = scene_with();
  scene.parameters.surface.cell = 0.5;
  const double d = scene.spacing();
  const auto volume = [&](const std::vector<Vec3>& particles) {
    const SurfaceMesh mesh = surface(scene, particles, densities(scene, particles));
    check_closed(mesh, scene);
    return enclosed_volume(mesh) / (d * d * d) / static_cast<double>(particles.size());
  };
  CHECK(volume({{0.013f, 0.1f, -0.2f}}) == Approx(1).epsilon(0.15));
  std::vector<Vec3> row;
  for (int k = 0; k < 20; ++k) row.push_back({static_cast<float>(k * d), 0.1f, 0.2f});
  CHECK(volume(row) == Approx(1).epsilon(0.35));
}

TEST_CASE("ten shapes of water, each with a closed surface") {
  const double d = 0.04;
  const auto random_share = [random = std::make_shared<std::mt19937>(3)](double share) {
    return [=](Vec3d) { return std::uniform_real_distribution<double>(0, 1)(*random) < share; };
  };
  const Cloud clouds[] = {
      {"ball", ball(0.5)},
      {"block in a corner", box({-1, -1, -1}, {-0.2, 0, 0.3})},
      {"block away from walls", box({-0.4, -0.4, -0.4}, {0.3, 0.2, 0.5})},
      {"the whole tank", box({-1, -1, -1}, {1, 1, 1})},
      {"a sheet one particle thick", box({-0.6, 0, -0.6}, {0.6, d, 0.6})},
      {"two balls that touch",
       [](Vec3d p) {
         return ball(0.3, {-0.3, 0, 0})(p) || ball(0.3, {0.3, 0, 0})(p);
       }},
      {"a ring", [](Vec3d p) { return std::hypot(std::hypot(p.x, p.y) - 0.5, p.z) < 0.15; }},
      {"a shell around a hollow", [](Vec3d p) { return length(p) < 0.7 && length(p) > 0.4; }},
      {"spray", random_share(0.05)},
      {"foam", random_share(0.5)},
  };
  for (const double cell : {2.0, 1.0}) {
    for (const Cloud& cloud : clouds) {
      Scene scene = scene_with(d / 2);
      scene.parameters.surface.cell = cell;
      CAPTURE(cloud.name, cell);
      check_closed(surface(scene, lattice(scene, cloud.inside)), scene);
    }
  }
}

TEST_CASE("a surface without smoothing is as closed") {
  Scene scene = scene_with();
  scene.parameters.surface.smoothing = 0;
  check_closed(surface(scene, lattice(scene,
                                      [random = std::make_shared<std::mt19937>(5)](Vec3d) {
                                        return std::uniform_real_distribution<double>(0, 1)(*random) < 0.3;
                                      })),
               scene);
}

TEST_CASE("at walls and periodic faces the surface is flat and lies in them") {
  for (const bool periodic : {false, true}) {
    Scene scene = scene_with();
    scene.domain.periodic[2] = periodic;
    const auto particles = lattice(scene, box({-1, -1, -1}, {1, 0, 1}));
    const SurfaceMesh mesh = surface(scene, particles);
    check_closed(mesh, scene);
    CHECK(enclosed_volume(mesh) == Approx(4).epsilon(0.005));
    std::array<int, 6> on_face{};
    for (const Vec3& p : mesh.position) {
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(p[axis]) < 1.0001f);
        if (std::abs(p[axis] + 1) < 1e-5f) ++on_face[static_cast<std::size_t>(2 * axis)];
        if (std::abs(p[axis] - 1) < 1e-5f) ++on_face[static_cast<std::size_t>(2 * axis + 1)];
      }
    }
    const int top = on_face[3];
    CHECK(top == 0);
    for (const std::size_t face : {0u, 1u, 2u, 4u, 5u}) CHECK(on_face[face] > 1000);
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {  // in the midst of the floor, straight down
      const Vec3 p = mesh.position[v];
      if (p.y < -0.9999f && std::abs(p.x) < 0.8f && std::abs(p.z) < 0.8f) CHECK(mesh.normal[v].y < -0.999f);
    }
  }
}

TEST_CASE("an open face lets the water stand out") {
  Scene scene = scene_with();
  scene.domain.walls[1].kind = WallKind::open;
  std::vector<Vec3> particles = lattice(scene, ball(0.3));
  for (Vec3& p : particles) p.x += 1;
  const SurfaceMesh mesh = surface(scene, particles);
  check_closed(mesh, scene);
  float farthest = 0;
  for (const Vec3& p : mesh.position) farthest = std::max(farthest, p.x);
  CHECK(farthest == Approx(1.3).margin(0.03));
}

TEST_CASE("a source with a matrix of its own is an ellipsoid, turned as the matrix says, and mirrored at walls") {
  Scene scene = scene_with();
  // |M x|^2 with semi-axes a, b, c along u, v, w; phi = (1 - |M x|^2)^3 - 1/2.
  const double a = 0.4, b = 0.32, c = 0.26, angle = 0.6;
  const Vec3d u{std::cos(angle), std::sin(angle), 0}, v{-std::sin(angle), std::cos(angle), 0}, w{0, 0, 1};
  const auto entry = [&](int i, int j) {
    return u[i] * u[j] / (a * a) + v[i] * v[j] / (b * b) + w[i] * w[j] / (c * c);
  };
  const auto reach = [&](int i) { return std::sqrt(u[i] * u[i] * a * a + v[i] * v[i] * b * b + w[i] * w[i] * c * c); };
  const SourceShape shape{to_float({entry(0, 0), entry(1, 1), entry(2, 2)}),
                          to_float({entry(1, 2), entry(2, 0), entry(0, 1)}), to_float({reach(0), reach(1), reach(2)})};
  const std::vector<SourceShape> shapes{shape, shape};
  const double q = std::sqrt(1 - std::cbrt(0.5)), volume = 4.0 / 3 * std::numbers::pi * q * q * q * a * b * c;
  const auto mesh_of = [&](const std::vector<Vec3>& places) {
    LevelSet level_set;
    level_set.build({places, {shapes.data(), places.size()}, {}, 0.04}, scene.domain, 0.05, 0.5);
    SurfaceMesh mesh;
    Polygoniser().run(level_set, Polygoniser::Normals::gradient, mesh);
    return mesh;
  };
  Vec3 one{0.1f, -0.2f, 0.3f}, other{-0.5f, 0.5f, -0.4f};
  one.w = other.w = 1;
  const SurfaceMesh mesh = mesh_of({one, other});
  CHECK(unpaired_sides(mesh) == 0);
  CHECK(enclosed_volume(mesh) == Approx(2 * volume).epsilon(0.08));
  for (const Vec3& p : mesh.position) {
    const Vec3d r = to_double(p - (length(p - one) < length(p - other) ? one : other));
    const double m = std::pow(dot(r, u) / a, 2) + std::pow(dot(r, v) / b, 2) + std::pow(dot(r, w) / c, 2);
    CHECK(std::sqrt(m) == Approx(q).epsilon(0.08));
  }
  // Half in the wall at x = 1: its image fills the other half, and half of both is inside.
  Vec3 in_wall{1, 0, 0};
  in_wall.w = 0.5f;
  const SurfaceMesh half = mesh_of({in_wall, one});
  CHECK(unpaired_sides(half) == 0);
  CHECK(enclosed_volume(half) > volume);
  CHECK(enclosed_volume(half) < 1.6 * volume);
}

TEST_CASE("what is deep in the water is not summed, and the surface is the same") {
  Scene scene = scene_with(0.01);
  const Inside block = box({-1, -1, -1}, {-0.2, -0.3, -0.1});
  // Foam has its holes everywhere, and nothing of it may be left out.
  const bool foam = GENERATE(false, true);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> draw(0, 1);
  std::vector<Vec3> particles = lattice(scene, [&](Vec3d p) { return block(p) && (!foam || draw(random) < 0.5); });
  for (Vec3& p : particles) p.w = 0.2f;
  const SourceShape shape = round_shape(2 * scene.spacing());
  const auto build = [&](double spacing, std::size_t& full) {
    LevelSet level_set;
    level_set.build({particles, {&shape, 1}, {}, spacing}, scene.domain, scene.particle_radius, 0.5);
    full = 0;
    for (const LevelSet::Brick& brick : level_set.bricks()) full += brick.full ? 1 : 0;
    SurfaceMesh mesh;
    Polygoniser().run(level_set, Polygoniser::Normals::gradient, mesh);
    return mesh;
  };
  std::size_t skipped = 0, none = 0;
  const SurfaceMesh mesh = build(scene.spacing(), skipped);
  const SurfaceMesh whole = build(0.01 * scene.spacing(), none);  // as if nothing were ever full
  CHECK(none == 0);
  CHECK((foam ? skipped == 0 : skipped > 50));
  REQUIRE(mesh.position.size() == whole.position.size());
  CHECK(mesh.triangles == whole.triangles);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) CHECK(length(mesh.position[v] - whole.position[v]) == 0);
}

TEST_CASE("the same mesh, to the bit, on 1, 2 and 4 threads and from used memory") {
  const Scene scene = scene_with();
  const auto particles = lattice(scene, [](Vec3d p) { return length(p) < 0.5 || p.y < -0.7; });
  const int threads = omp_get_max_threads();
  SurfaceMaker used;
  used.make({lattice(scene, ball(0.9)), {}}, scene);
  std::vector<SurfaceMesh> meshes;
  for (const int n : {1, 2, 4}) {
    omp_set_num_threads(n);
    meshes.push_back(n == 2 ? used.make({particles, {}}, scene) : surface(scene, particles));
  }
  omp_set_num_threads(threads);
  for (const SurfaceMesh& mesh : meshes) {
    REQUIRE(mesh.position.size() == meshes[0].position.size());
    CHECK(mesh.triangles == meshes[0].triangles);
    const auto bytes = mesh.position.size() * sizeof(Vec3);
    CHECK(std::memcmp(mesh.position.data(), meshes[0].position.data(), bytes) == 0);
    CHECK(std::memcmp(mesh.normal.data(), meshes[0].normal.data(), bytes) == 0);
  }
}

TEST_CASE("smoothing takes the bumps of a level pool and leaves its volume") {
  Scene scene = scene_with();
  const auto particles = lattice(scene, box({-1, -1, -1}, {1, 0, 1}));
  const auto roughness = [&](int passes) {
    scene.parameters.surface.smoothing = passes;
    const SurfaceMesh mesh = surface(scene, particles);
    CHECK(enclosed_volume(mesh) == Approx(4).epsilon(0.005));
    double sum = 0, square = 0, n = 0;
    for (const Vec3& p : mesh.position) {
      if (p.y < -0.2f || std::abs(p.x) > 0.9f || std::abs(p.z) > 0.9f) continue;
      const auto height = static_cast<double>(p.y);
      n += 1;
      sum += height;
      square += height * height;
    }
    return std::sqrt(square / n - sum / n * sum / n);
  };
  const double plain = roughness(0);
  CAPTURE(plain, roughness(3), roughness(20));
  CHECK(plain < 0.1 * scene.spacing());
  CHECK(roughness(3) < 0.9 * plain);
  CHECK(roughness(20) < 0.7 * plain);
}

TEST_CASE("vertices have the velocity of the water") {
  const Scene scene = scene_with();
  const auto particles = lattice(scene, [](Vec3d p) { return p.y < -0.3; });
  std::vector<Vec3> velocity;
  for (const Vec3& p : particles) velocity.push_back({2 + p.x, 0, -p.z});
  SurfaceMaker maker;
  const SurfaceMesh mesh = maker.make({particles, {}, velocity}, scene);
  REQUIRE(mesh.velocity.size() == mesh.position.size());
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3 p = mesh.position[v];
    if (std::abs(p.x) > 0.9f || std::abs(p.z) > 0.9f) continue;  // images at a wall move with the mirror
    CHECK(length(mesh.velocity[v] - Vec3{2 + p.x, 0, -p.z}) < 0.02f);
  }
  CHECK(maker.make({particles, {}}, scene).velocity.empty());
}

TEST_CASE("a particle far out, or nowhere, does no harm") {
  Scene scene = scene_with();
  for (Wall& wall : scene.domain.walls) wall.kind = WallKind::open;
  std::vector<Vec3> particles = lattice(scene, ball(0.3));
  const SurfaceMesh alone = surface(scene, particles);
  for (const float far : {500.0f, 1e30f, NAN, -INFINITY}) {
    CAPTURE(far);
    particles.push_back({0, far, 0});
    const SurfaceMesh mesh = surface(scene, particles);
    particles.pop_back();
    CHECK(unpaired_sides(mesh) == 0);
    CHECK(enclosed_volume(mesh) == Approx(enclosed_volume(alone)).epsilon(0.002));
  }
}

TEST_CASE("no water, no surface") {
  const Scene scene = scene_with();
  const SurfaceMesh mesh = surface(scene, {});
  CHECK(mesh.empty());
  CHECK(mesh.position.empty());
}

TEST_CASE("a kernel that reaches over more cells than a brick has is refused, in a sentence") {
  Scene scene = scene_with();
  scene.parameters.surface.cell = 0.5;
  scene.parameters.surface.kernel_radius = 3;
  CHECK_THROWS_WITH(surface(scene, {{0, 0, 0}}),
                    "surface.kernel_radius is 3, expected at most 2 with surface.cell 0.5");
}
