// Probes: pressure, velocity and water height at points of the scene, from the particles around them.
//
// Pressure and velocity are those of the plane A(x) = a + b . (x - x_0) that fits the particles within the support
// best, each counting by its kernel W(x_0 - x_j): weighted least squares of first order. It is exact for linear fields,
// also at walls, where the kernel-weighted mean (Shepard 1968) has the value from half a spacing further in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/core/world.h"

namespace curlew {

// Fields that the probes of the scene read and no step needs.
FieldSet probe_fields(const Scene& scene);

// Columns of a probe: its name; of a line name[0], name[1] ...; of a velocity with .x, .y and in 3D .z.
std::vector<std::string> probe_columns(const Probe& probe, int dimension);

// As many values as columns: Pa, m/s, or m above the domain's lowest point. Empty where no particle is within the
// support, where a column of water_height has no water, and for pressure before the first step, which finds it.
// The same bits on any number of threads.
std::vector<std::optional<double>> measure(const World& world, const Probe& probe);

}  // namespace curlew
