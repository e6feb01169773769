// Where the eye is: a scene's camera, completed so that the whole domain is in sight where the scene leaves it open.
#pragma once

#include "render/matrix.h"
#include "sim/core/vec.h"
#include "sim/scene/scene.h"

namespace curlew {

// A camera, resolved. View space has x to the right, y up, and looks along -z.
struct View {
  Vec3d position;
  Vec3d right, up, forward;  // orthonormal, in world space; forward points into the picture
  bool orthographic = false;
  double half_height = 0;  // of the picture at distance 1 (perspective), or in metres (orthographic)
  double aspect = 1;       // width over height
  double near = 0, far = 0;

  Matrix4 world_to_view() const;
  Matrix4 view_to_world() const;
  // Depth runs from 1 at near to 0 at far (reversed, for glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE)): with floating
  // point depth that keeps precision even over a large floor.
  Matrix4 view_to_clip() const;
  Matrix4 clip_to_view() const;
};

// 3D: perspective; a three-quarter view from the front and above, as near as shows all of the domain beside the legend.
// 2D: orthographic and straight on; the whole domain fits, camera.target (or position) moves the centre.
// camera.field_of_view is vertical. Throws InputError where position and target coincide.
// right_margin is the part of the width that a fitted domain leaves free at the right.
View view_of(const Camera& camera, const Domain& domain, int dimension, double aspect, double right_margin = 0.08);

// Where a point falls: x and y in -1..1 over the picture, y up; z is the distance along forward, in metres.
Vec3d project(const View& view, Vec3d point);

}  // namespace curlew
