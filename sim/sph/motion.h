// Forces that are not pressure, the time step, and the moves.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// Starts the field acceleration: a = g.
void gravity(World& world);

// a += nu lap v, explicit, with the pull of no-slip boundaries.
//   scalar form  2 sum V_j v_ij (x_ij . grad W_ij) / (|x_ij|^2 + 0.01 h^2)                  (Brookshaw 1985)
//   vector form  2 (D+2) sum V_j (v_ij . x_ij) / (|x_ij|^2 + 0.01 h^2) grad W_ij            (Monaghan 1992; Liu Eq. 4)
void viscosity(World& world);

// dt = min( cfl d / |v|max, of fluid and of bodies, f sqrt(d / |a|max), f d^2 / nu, growth times the last, max_step ),
// or the fixed step.
void choose_time_step(World& world);

// v += dt a.
void apply_forces(World& world);

// XSPH: v_i += gamma sum_j (m / mean(rho_i, rho_j)) (v_j - v_i) W_ij, with symmetric weights, which keep momentum
// (Schechter & Bridson 2012; Bender et al. 2018). As a rate, gamma becomes gamma dt / reference
// step, and dt is limited so that this stays below one half.
void xsph(World& world);

// Particle shifting for filled domains (Lind et al. 2012; Skillen et al. 2013): x_i -= A h |v|max dt grad C_i with
// grad C_i = sum V_j grad W_ij, at most a fifth of a spacing; |v|max as seen by the fluid on the whole. Streamlines
// would else draw particles out into strings, which both signs of pressure then pull together.
// The sum sees walls as reflections that stay where they are: boundary_gradient, whose image moves against the particle
// (sim/sph/walls.h), is twice that, and kept the lowest layer 0.63 d from a wall, where friction is half of what it
// should be: a channel at Re 100 flowed 6 % too fast, now 0.3 %.
// Whatever moves a particle beside its own velocity, the density solve's displacement too, takes it to where the flow
// is another: v_i += dx . grad v to first order, the gradient corrected and with reflections in walls.
// Without it vorticity refinement takes a new disorder for a gain and brakes jittered Taylor-Green vortices by 3 % in
// one step.
void shift_particles(World& world);

// x += dt v (symplectic Euler), walls held, periodic axes wrapped.
void advect(World& world);

// Takes particles away that left the domain through an open face and are out of the others' reach.
void remove_escaped(World& world);

// The step that a world at rest would like, for its first divergence solve.
double initial_time_step(const World& world);

// Curl of the velocity in the difference form, sum V_j (v_i - v_j) x grad W_ij (Liu et al. 2020, Eq. 6), into
// vorticity, 1/s.
void compute_vorticity(World& world);

}  // namespace curlew
