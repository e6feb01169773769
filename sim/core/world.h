// Everything a run holds. Plain state: passes (sim/core/passes.h) read and write it, nothing else does.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/core/fields.h"
#include "sim/scene/scene.h"
#include "sim/sph/bodies.h"
#include "sim/sph/grid.h"
#include "sim/sph/kernel.h"
#include "sim/sph/neighbours.h"
#include "sim/sph/obstacles.h"
#include "sim/sph/walls.h"
#include "sim/turbulence/vector_potential.h"
#include "sim/turbulence/wavelet_noise.h"

namespace curlew {

// What the passes of one step found; errors are fractions of the rest density, means over all particles.
struct StepReport {
  int pressure_iterations = 0, divergence_iterations = 0;
  int limit_hits = 0;                 // solves that ended at their iteration limit
  double density_error_avg = 0;       // predicted compression after the density solve
  double density_error_true_avg = 0;  // compression of the density sum at the new positions
  double density_error_true_max = 0;
  double divergence_error = 0;     // compression rate times dt after the divergence solve
  double divergence_skipped = 0;   // share of particles with too few neighbours for that solve
  double max_speed = 0;            // m/s
  double max_acceleration = 0;     // m/s^2
  std::int64_t wall_contacts = 0;  // particles held at a wall or a body
  double body_work = 0;            // J, that moving bodies do on the fluid by its pressure
  double guard_scale = 1;          // share of the turbulence models' work that the energy guard let through
};

// Work done since the start, for tests that guard cost without a clock.
struct WorkCount {
  std::uint64_t pair_visits = 0;  // neighbour pairs over all sweeps
  std::uint64_t sweeps = 0;
};

// What the velocity and the warm start were before the step: with the positions, which move last, this is the state
// before a step that went wrong.
struct Backup {
  Array<Vec3> velocity, microrotation, predicted_vorticity;
  Array<float> density_stiffness, divergence_stiffness;
};

// What the energy guard keeps (sim/turbulence/energy_guard.h), in J.
struct EnergyAccount {
  double reserve = 0;                // that the turbulence models may add; state
  double outer_work = 0, given = 0;  // by viscosity and external torque, and by the models, in the step in hand
};

// What the water began with, for the watch (sim/core/watch.h). State.
struct Start {
  double speed = 0;   // m/s, of the fastest particle
  double energy = 0;  // J, mechanical and of microrotation
  bool known = false;
};

// The noise of wavelet turbulence: kept while its pass is planned.
struct WaveletState {
  std::shared_ptr<const WaveletNoise> noise;
  double mean_energy = 0;  // m^2/s^2, of the particles on which it acted in this step
  double moved = 0;        // cells of the coarsest octave by which the noise has moved on; state
};

struct World {
  Scene scene;
  std::uint64_t seed = 0;

  Kernel kernel;
  float mass = 0;  // kg; per metre of depth in 2D
  CellShape cells;
  Walls walls;
  BodySamples bodies;
  std::shared_ptr<const Obstacles> obstacles;  // never null
  std::vector<BodyPlace> body_places;          // now, for each body of the scene; empty where none moves

  std::size_t count = 0;  // particles
  Fields fields;
  Grid grid;
  NeighbourLists neighbours;

  std::int64_t step = 0;
  double time = 0;  // s
  double dt = 0;    // s, of the last step; before the first, the step it would like
  EnergyAccount energy;
  Start start;
  StepReport report;
  WorkCount work;
  Backup backup;

  VectorPotential potential;  // empty while no pass needs it
  WaveletState wavelet;

  // Reused by the sort.
  std::vector<std::uint32_t> order;
  Fields sort_space;

  const Parameters& parameters() const { return scene.parameters; }
  float rest_density() const { return static_cast<float>(scene.parameters.sph.rest_density); }
  bool has_boundary() const { return walls.any() || bodies.count() > 0; }
  // Below this many neighbours a particle is spray: the divergence solve leaves it alone.
  float least_neighbours() const { return scene.dimension == 3 ? 20.0f : 7.0f; }
};

// Lays out the particles of a scene. Throws InputError where the scene cannot be laid out (too many particles, ...).
World make_world(const Scene& scene, std::uint64_t seed = 0);

// A world without its particles: for a checkpoint, which brings them.
World make_empty_world(const Scene& scene, std::uint64_t seed = 0);

// Bytes that the solver holds for its particles, lists and boundaries (capacity, not use).
std::size_t allocated_bytes(const World& world);

}  // namespace curlew
