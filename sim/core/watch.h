// Notices that a run has left the range in which it means anything, and says so: pass, particle, cause, and what to
// change.
//
// Three signs, from sudden to slow:
//   a velocity that is not finite, or that would move a particle by more than time.max_displacement in the step;
//   a speed beyond time.max_speed times what the scene can bring forth: the speed at the start, of moving walls and
//   of moving bodies, and free fall through the domain. The time step follows the speed, so the first sign alone would
//   let it grow for ever;
//   a mechanical energy beyond time.max_energy times that of the start, where nothing may add any.
#pragma once

#include <string_view>

#include "sim/core/world.h"

namespace curlew {

// Takes down what the water begins with, unless the world (a checkpoint) knows it already.
void remember_start(World& world);

// Counts from now on as the start: for a run that goes on although it failed.
void forgive(World& world);

// Throws DivergedError, naming `pass`, where a velocity shows one of the first two signs.
void check_velocities(const World& world, std::string_view pass);

// A pass: throws DivergedError for the third sign. While something may add energy (moving walls, a body on its way, a
// torque, turbulence models without the energy guard) it only keeps the highest energy as the start's.
void watch_energy(World& world);

}  // namespace curlew
