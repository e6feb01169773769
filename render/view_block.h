// What all shaders share: camera, light and theme, laid out as shaders/common.glsl reads them.
#pragma once

#include <array>

#include "render/camera.h"
#include "render/matrix.h"
#include "render/theme.h"
#include "sim/core/frame.h"

namespace curlew {

using Vector4 = std::array<float, 4>;

// std140: matrices and vectors of four only, so no padding anywhere.
struct ViewBlock {
  Matrix4 world_to_view, view_to_world, view_to_clip, clip_to_view, world_to_light;
  Vector4 size, key_direction, up, domain_min, domain_max;
  Vector4 key_colour, sky_colour, ground_colour, background_top, background_bottom, floor_colour, grid_colour,
      body_colour, line_colour, sampling;
};

// The key light's map: a square that holds the domain, seen along the light.
struct LightMap {
  Matrix4 world_to_light;
  double metres = 0;  // side of the square
  View view;          // the same as a view
};
LightMap light_map_of(const Domain& domain, Vec3d to_light);

// Towards the lamp, in world space: over the viewer's left shoulder, so that shadows fall away from us to the right.
Vec3d key_direction(const View& view, int dimension);

// width and height as drawn, that is, `samples` times the picture's.
ViewBlock view_block(const View& view, const Theme& theme, const FrameGeometry& geometry, const LightMap& light,
                     double particle_radius, int width, int height, double samples);

}  // namespace curlew
