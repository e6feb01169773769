#include "render/view_block.h"

#include <algorithm>
#include <cmath>

namespace curlew {
namespace {

Vec3d normalised(Vec3d a) { return (1 / length(a)) * a; }

Vector4 four(Vec3d a, double w) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z), static_cast<float>(w)};
}

Vector4 four(const Colour& c, double w = 0) { return {c[0], c[1], c[2], static_cast<float>(w)}; }

Vec3d to_view(const View& view, Vec3d direction) {
  return {dot(direction, view.right), dot(direction, view.up), -dot(direction, view.forward)};
}

}  // namespace

Vec3d key_direction(const View& view, int dimension) {
  if (dimension == 2) return normalised({-0.45, 0.65, 0.75});
  // Turned about the vertical with the camera, never below the horizon.
  const Vec3d back{-view.forward.x, 0, -view.forward.z}, side{view.right.x, 0, view.right.z};
  const Vec3d level = length(back) > 1e-6 ? normalised(back) : Vec3d{0, 0, 1};
  return normalised(0.48 * level + -0.62 * normalised(side) + Vec3d{0, 1.0, 0});
}

LightMap light_map_of(const Domain& domain, Vec3d to_light) {
  const Vec3d centre = 0.5 * (domain.min + domain.max);
  const double size = length(domain.max - domain.min);
  const Vec3d helper = std::abs(to_light.y) > 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d u = normalised(cross(helper, to_light)), v = cross(to_light, u);
  LightMap light;
  light.metres = size;
  const double scale = 1 / size;
  set_row(light.world_to_light, 0, scale * u, 0.5 - scale * dot(u, centre));
  set_row(light.world_to_light, 1, scale * v, 0.5 - scale * dot(v, centre));
  set_row(light.world_to_light, 2, -scale * to_light, 0.5 + scale * dot(to_light, centre));
  light.view.position = centre + size * to_light;
  light.view.right = u;
  light.view.up = v;
  light.view.forward = -1.0 * to_light;
  light.view.orthographic = true;
  light.view.half_height = 0.5 * size;
  return light;
}

ViewBlock view_block(const View& view, const Theme& theme, const FrameGeometry& geometry, const LightMap& light,
                     double particle_radius, int width, int height, double samples) {
  const Domain& domain = geometry.domain;
  const double diagonal = length(domain.max - domain.min);
  ViewBlock b;
  b.world_to_view = view.world_to_view();
  b.view_to_world = view.view_to_world();
  b.view_to_clip = view.view_to_clip();
  b.clip_to_view = view.clip_to_view();
  b.world_to_light = light.world_to_light;
  b.size = {static_cast<float>(width), static_cast<float>(height), 1 / static_cast<float>(width),
            1 / static_cast<float>(height)};
  b.key_direction = four(to_view(view, key_direction(view, geometry.dimension)), view.orthographic ? 1 : 0);
  b.up = four(to_view(view, {0, 1, 0}), geometry.dimension);
  b.domain_min = four(domain.min, particle_radius);
  b.domain_max = four(domain.max, 2 * view.half_height / height);
  b.key_colour = four(theme.key, theme.key_in_shadow);
  b.sky_colour = four(theme.sky, theme.reflections);
  b.ground_colour = four(theme.ground, theme.occlusion);
  b.background_top = four(theme.background_top);
  b.background_bottom = four(theme.background_bottom);
  b.floor_colour = four(theme.floor, 2.2 * diagonal);
  b.grid_colour = four(theme.grid, theme.grid_strength);
  b.body_colour = four(theme.body);
  b.line_colour = four(theme.line, theme.line_opacity);
  b.sampling = {static_cast<float>(samples), 0, 0, 0};
  return b;
}

}  // namespace curlew
