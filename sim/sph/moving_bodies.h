// Bodies on their way: where they are, what their motion does to the fluid, and how fast they are.
//
// The density that samples b at v_b add to a particle i changes by sum rho_0 V_b (v_i - v_b) . grad W_ib (Akinci et al.
// 2012). The pressure solves see bodies at rest in their operator, for what pressure does to bodies moves none of them,
// and the part with v_b in their source: the field body_motion.
// Over a step from t to t + dt, the body at X(t):
//   the divergence solve takes v_b = X'(t), as it takes the fluid's velocity at t;
//   friction and curls take X'(t);
//   the density solve, which predicts densities at t + dt, takes the mean v_b = (X(t + dt) - X(t)) / dt;
//   then the samples and the shapes go to X(t + dt), and particles that are in their way are put on their surface and
//   get at least their velocity X'(t + dt) along its normal.
#pragma once

#include "sim/core/world.h"

namespace curlew {

// Puts bodies where they are at a time, s; nothing where none moves.
void place_bodies(World& world, double time);

// A pass: body_motion for the velocities of the place where the bodies are, and the pull of moving no-slip surfaces
// onto boundary_friction.
void sum_body_motion(World& world);

// A pass: the w of body_motion for the mean velocities of the step in hand. Curls have been taken by then.
void sum_body_course(World& world);

// A pass: the bodies go where they are at the end of the step.
void move_bodies(World& world);

// A bound of the speed of all bodies (m/s) from one time to a later one, and for all times.
double body_speed(const Scene& scene, double from, double to);
double body_speed(const Scene& scene);

// Whether any body is on its way at some time from `from` to `to`.
bool bodies_move(const Scene& scene, double from, double to);

}  // namespace curlew
