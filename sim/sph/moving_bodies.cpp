#include "sim/sph/moving_bodies.h"

#include <algorithm>

#include "sim/core/parallel.h"

namespace curlew {
namespace {

// Calls use(particle, sums) for all particles that moving samples may reach.
template <class Use>
void for_moving_samples(const World& world, Use&& use) {
  const Grid& grid = world.grid;
  constexpr std::size_t chunk = 16;
#pragma omp parallel
  {
    Candidates near;
    Grid::Hints hints;
#pragma omp for schedule(dynamic, 1)
    for (std::size_t first = 0; first < grid.cell_number(); first += chunk) {
      for (std::size_t cell = first; cell < std::min(first + chunk, grid.cell_number()); ++cell) {
        if (!world.bodies.moving_near(world.cells, grid.coordinates(cell))) continue;
        world.bodies.collect(world.cells, grid.coordinates(cell), near, hints);
        if (near.size == 0) continue;
        for (std::uint32_t i = grid.begin(cell); i < grid.end(cell); ++i) {
          use(i, world.bodies.motion(world.fields.position[i], near, world.kernel, world.rest_density()));
        }
      }
    }
  }
}

}  // namespace

void place_bodies(World& world, double time) {
  if (!world.bodies.any_moving()) return;
  world.body_places = body_places(world.scene.bodies, time);
  world.bodies.place(world.cells, world.body_places);
}

void sum_body_motion(World& world) {
  Fields& f = world.fields;
  const bool friction = !f.boundary_friction.empty();
  parallel_for(world.count, [&](std::size_t i) { f.body_motion[i] = {}; });
  for_moving_samples(world, [&](std::size_t i, const MotionSum& sums) {
    f.body_motion[i] = sums.motion;
    if (friction) f.boundary_friction[i] += sums.friction;
  });
}

void sum_body_course(World& world) {
  std::vector<BodyPlace> course = world.body_places;
  const std::vector<BodyPlace> next = body_places(world.scene.bodies, world.time + world.dt);
  for (std::size_t k = 0; k < course.size(); ++k) {
    course[k].velocity = (1 / world.dt) * (next[k].offset - course[k].offset);
  }
  world.bodies.set_velocities(course);
  for_moving_samples(world,
                     [&](std::size_t i, const MotionSum& sums) { world.fields.body_motion[i].w = sums.motion.w; });
}

void move_bodies(World& world) { place_bodies(world, world.time + world.dt); }

double body_speed(const Scene& scene, double from, double to) {
  double top = 0;
  for (const Body& body : scene.bodies) top = std::max(top, body.motion.top_speed(from, to));
  return top;
}

double body_speed(const Scene& scene) {
  double top = 0;
  for (const Body& body : scene.bodies) top = std::max(top, body.motion.top_speed());
  return top;
}

bool bodies_move(const Scene& scene, double from, double to) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const Body& body) { return body.motion.moves_between(from, to); });
}

}  // namespace curlew
