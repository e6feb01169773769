// What a scene costs at its particle radius, whether that can work, and the radius for a wanted number of particles.
#pragma once

#include <string>

#include "sim/scene/scene.h"

namespace curlew {

// Number of particles from the volumes of the fluids (a double: absurd scenes overflow integers). Exact to some per
// cent for simple shapes; overlaps and bodies are not subtracted.
double estimate_particles(const Scene&);

// Bytes that a run needs: 700 a particle and, while bodies are sampled, 1000 a body sample; estimated from
// volumes and surfaces.
double estimate_memory(const Scene&);

// Throws InputError where the scene cannot run at its particle radius: more than 2^31 particles or more memory than the
// machine has, a domain so wide that single precision no longer resolves the spacing, a periodic width that is below 4
// kernel supports or no whole multiple of the spacing. To be called again when the radius changes; sample_fluid does.
void check_resolution(const Scene&);
void check_resolution(const Scene&, double memory_of_machine);  // bytes

// Physical memory of this machine (bytes).
double machine_memory();

// The scene with the particle radius that comes nearest to n particles, among the radii at which the first box of fluid
// divides evenly along its shortest edge (and the domain along its periodic axes). Throws InputError for n < 1.
Scene with_particles(Scene, double n);

// A number of bytes as people write it: "2.8 EB", "24 GB".
std::string bytes_text(double bytes);

}  // namespace curlew
