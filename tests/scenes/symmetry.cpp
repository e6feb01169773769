// Space has no place, direction, handedness or speed of its own: a run that is moved, turned or mirrored as a whole has
// the same answer. Vorticity and spin are axial vectors: a mirror turns them round once more.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string_view>

#include "tests/scenes/scene_test.h"

using namespace curlew;

namespace {

// Where a map about the origin takes the axes, and what it does to handedness.
struct Map {
  const char* name;
  Vec3d x, y, z;
  double handedness;

  Vec3d operator()(Vec3d a) const { return a.x * x + a.y * y + a.z * z; }
  Vec3d axial(Vec3d a) const { return handedness * (*this)(a); }
};

constexpr Vec3d ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};
constexpr Vec3d minus_x{-1, 0, 0}, minus_y{0, -1, 0}, minus_z{0, 0, -1};
constexpr Map same{"as it is", ex, ey, ez, 1};
constexpr Map mirrored{"mirrored", minus_x, ey, ez, -1};
constexpr Map turned{"turned by 90 degrees", ey, minus_x, ez, 1};
constexpr Map exchanged{"axes exchanged in turn", ey, ez, ex, 1};
constexpr Map both{"turned about y and mirrored", minus_z, minus_y, ex, -1};

// One model at a time, and none, each without the energy guard: what energy a model adds depends on the frame where it
// adds momentum too, as confinement and the micropolar model do.
struct Model {
  const char* name;
  void (*set)(Parameters&);
};
constexpr Model models[] = {
    {"plain", [](Parameters&) {}},
    {"refinement", [](Parameters& p) { p.vorticity_refinement.alpha = 1; }},
    {"refinement by the sum",
     [](Parameters& p) {
       p.vorticity_refinement.alpha = 1;
       p.vorticity_refinement.reconstruction = VorticityRefinementParameters::reconstruction_t::sum;
     }},
    {"micropolar", [](Parameters& p) { p.micropolar.nu_t = 0.05; }},
    {"confinement", [](Parameters& p) { p.vorticity_confinement.epsilon = 0.1; }},
};
constexpr Model all_guarded{"all, guarded", [](Parameters& p) {
                              for (const Model& model : models) {
                                if (std::string_view(model.name) != "refinement by the sum") model.set(p);
                              }
                              p.energy.guard = true;
                              p.pressure.conserving = false;  // so that there is a loss to give back
                              p.pressure.divergence_tolerance = 1e-5;
                            }};

// A periodic square or cube of 1 m around the origin, full of fluid off its lattice.
Scene periodic_box(int dimension, int particles_per_metre, const Model& model) {
  Scene scene = at_particles_per_metre(bundled("taylor_green"), particles_per_metre);
  const double z = dimension == 3 ? 0.5 : 0;
  scene.dimension = dimension;
  scene.domain.min = {-0.5, -0.5, -z};
  scene.domain.max = {0.5, 0.5, z};
  scene.domain.periodic[2] = dimension == 3;
  scene.fluid[0].shape = Box{scene.domain.min, scene.domain.max};
  scene.parameters.viscosity.nu = 1e-3;
  scene.parameters.time.fixed_step = 4e-3;
  // Particles that lie across each other at the start fly apart, and make 1e-2 of the velocity out of round-off.
  scene.fluid[0].jitter = 0.1;
  scene.parameters.pressure.relative_tolerance = 0.02;  // round-off decides in which iteration a loose solve stops
  scene.parameters.energy.guard = false;
  model.set(scene.parameters);
  return scene;
}

// In 3D a flow of one handedness, the same as its curl but for the factor 2 pi (Arnold, Beltrami, Childress).
Vec3d helical(Vec3d x) {
  const double k = 2 * std::numbers::pi, a = 0.7, b = 0.5, c = 0.3;
  return {a * std::sin(k * x.z) + c * std::cos(k * x.y), b * std::sin(k * x.x) + a * std::cos(k * x.z),
          c * std::sin(k * x.y) + b * std::cos(k * x.x)};
}

// What a run came to, seen from the start's own frame.
struct Answer {
  double kinetic = 0, rotational = 0;
  std::vector<Vec3d> velocity, spin;
};

Answer answer(const Scene& scene, const Map& map, Vec3d drift, double time) {
  World world = make_world(scene);
  Fields& f = world.fields;
  for (std::size_t i = 0; i < world.count; ++i) {
    const Vec3d x = to_double(f.position[i]);
    f.position[i] = to_float(map(x));
    f.velocity[i] = to_float(map(scene.dimension == 3 ? helical(x) : to_double(f.velocity[i])) + drift);
  }
  Run run(std::move(world));
  run.simulate(time);
  const World& now = run.world;
  Answer result{0, run.now().sums.rotational, velocities_by_id(now), by_id(now, now.fields.microrotation)};
  for (Vec3d& v : result.velocity) {
    v = v - drift;
    result.kinetic += double{now.mass} / 2 * dot(v, v);
  }
  return result;
}

// The root mean square of b - map(a) over that of a.
template <class Mapped>
double distance(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b, Mapped&& map) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += dot(b[i] - map(a[i]), b[i] - map(a[i]));
    size += dot(a[i], a[i]);
  }
  return std::sqrt(difference / size);
}

// How far two answers may be apart: in energies, and in the fields.
constexpr double energy_tolerance = 1e-4, field_tolerance = 3e-3;

void check_same(const Answer& expected, const Answer& found, const Map& map) {
  const double apart = distance(expected.velocity, found.velocity, map);
  INFO("velocities apart by " << apart << ", kinetic energy by " << found.kinetic / expected.kinetic - 1);
  CHECK(found.kinetic == Approx(expected.kinetic).epsilon(energy_tolerance));
  CHECK(apart < field_tolerance);
  if (expected.spin.empty()) return;
  const double spins = distance(expected.spin, found.spin, [&](Vec3d a) { return map.axial(a); });
  INFO("spins apart by " << spins << ", their energy by " << found.rotational / expected.rotational - 1);
  CHECK(found.rotational == Approx(expected.rotational).epsilon(energy_tolerance));
  CHECK(spins < field_tolerance);
}

}  // namespace

TEST_CASE("Taylor-Green vortices are the same in a moving frame, mirrored and turned", "[symmetry]") {
  for (const Model& model : models) {
    const Scene scene = periodic_box(2, 40, model);
    const Answer plain = answer(scene, same, {}, 0.2);
    {
      INFO(model.name << ", moving");
      check_same(plain, answer(scene, same, {0.3, 0, 0}, 0.2), same);
    }
    for (const Map& map : {mirrored, turned}) {
      INFO(model.name << ", " << map.name);
      check_same(plain, answer(scene, map, {}, 0.2), map);
    }
  }
}

TEST_CASE("a helical flow in 3D is the same in a moving frame, mirrored and turned", "[symmetry]") {
  for (const Model& model : models) {
    const Scene scene = periodic_box(3, 14, model);
    const Answer plain = answer(scene, same, {}, 0.06);
    {
      INFO(model.name << ", moving");
      check_same(plain, answer(scene, same, {0.1, 0.2, 0.3}, 0.06), same);
    }
    for (const Map& map : {mirrored, exchanged, both}) {
      INFO(model.name << ", " << map.name);
      check_same(plain, answer(scene, map, {}, 0.06), map);
    }
  }
}

TEST_CASE("all models together under the guard know no direction and no handedness", "[symmetry]") {
  const int dimension = GENERATE(2, 3);
  const Scene scene = periodic_box(dimension, dimension == 2 ? 40 : 14, all_guarded);
  const Answer plain = answer(scene, same, {}, 0.1);
  for (const Map& map : {mirrored, dimension == 2 ? turned : both}) {
    INFO(dimension << "D, " << map.name);
    check_same(plain, answer(scene, map, {}, 0.1), map);
  }
}
