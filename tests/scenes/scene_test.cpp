#include "tests/scenes/scene_test.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "sim/core/parallel.h"
#include "sim/measure/state_hash.h"
#include "sim/scene/bundled.h"
#include "sim/scene/reader.h"

namespace curlew {

Scene bundled(const std::string& name) { return read_scene(find_scene(name, CURLEW_ASSETS_DIR)); }

Scene at_particles_per_metre(Scene scene, int number) {
  scene.particle_radius = 0.5 / number;
  return scene;
}

Scene empty_box(Vec3d size, int particles_per_metre) {
  Scene scene;
  scene.dimension = size.z > 0 ? 3 : 2;
  scene.domain.max = size;
  return at_particles_per_metre(std::move(scene), particles_per_metre);
}

Fluid moving(Shape shape, Vec3d velocity) {
  Fluid fluid{std::move(shape), {}};
  fluid.velocity.value = velocity;
  return fluid;
}

Fluid with_shear_wave(Shape shape, double speed) {
  Fluid fluid{std::move(shape), {}};
  fluid.velocity.field = InitialVelocity::Field::shear_wave;
  fluid.velocity.speed = speed;
  return fluid;
}

World jittered(World world, double spacings) {
  std::mt19937 random(7);
  const auto most = static_cast<float>(spacings * world.scene.spacing());
  std::uniform_real_distribution<float> shift(-most, most);
  for (Vec3& x : world.fields.position) {
    for (int axis = 0; axis < world.scene.dimension; ++axis) x[axis] += shift(random);
  }
  return world;
}

Run::Run(const Scene& scene, FieldSet demanded) : Run(make_world(scene), demanded) {}

Run::Run(World changed, FieldSet demanded) : world(std::move(changed)), plan_(make_plan(world, demanded)) {
  prepare(world, plan_);
  remember();
}

void Run::remember() {
  history_.push_back({world.time, world.dt, diagnose(world), world.report, count_outside(world)});
}

void Run::simulate(double seconds) {
  // Half a step of slack: a fixed step that divides the time is not taken once too often for round-off.
  for (const double end = world.time + seconds; world.time < end - 0.5 * world.dt;) take_steps(1);
}

void Run::take_steps(int number) {
  for (int k = 0; k < number; ++k) {
    step(world, plan_);
    remember();
  }
}

double Run::energy_rise(double window) const {
  double most = 0;
  for (std::size_t late = 1; late < history_.size(); ++late) {
    for (std::size_t early = late; early-- > 0 && history_[early].time >= history_[late].time - window;) {
      const double before = history_[early].sums.mechanical();
      most = std::max(most, (history_[late].sums.mechanical() - before) / before);
    }
  }
  return most;
}

double rms_speed(const World& world) {
  return std::sqrt(2 * kinetic_energy(world) / (double{world.mass} * static_cast<double>(world.count)));
}

double absolute_momentum(const World& world) {
  const Array<Vec3>& v = world.fields.velocity;
  return double{world.mass} * particle_sum(world.count, [&](std::size_t i) { return length(to_double(v[i])); });
}

std::vector<Vec3d> by_id(const World& world, const Array<Vec3>& field) {
  std::vector<Vec3d> sorted;
  if (field.empty()) return sorted;
  for (std::uint32_t place : order_by_id(world.fields.id)) sorted.push_back(to_double(field[place]));
  return sorted;
}

std::vector<Vec3d> positions_by_id(const World& world) { return by_id(world, world.fields.position); }
std::vector<Vec3d> velocities_by_id(const World& world) { return by_id(world, world.fields.velocity); }

double shear_wave_number(const Scene& scene) {
  return 2 * std::numbers::pi / (scene.domain.max.y - scene.domain.min.y);
}

double shear_wave_amplitude(const World& world) {
  const double k = shear_wave_number(world.scene), low = world.scene.domain.min.y;
  const Fields& f = world.fields;
  return 2 / static_cast<double>(world.count) * particle_sum(world.count, [&](std::size_t i) {
           return double{f.velocity[i].x} * std::sin(k * (double{f.position[i].y} - low));
         });
}

}  // namespace curlew
