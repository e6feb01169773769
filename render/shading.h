// Everything after the G-buffer: smoothing, occlusion, light, and the way to the final picture. Owns all targets.
#pragma once

#include <algorithm>
#include <cmath>

#include "render/gl.h"
#include "render/theme.h"

namespace curlew {

class Shading {
 public:
  // samples: drawn pixels for each one of the picture, along one side: 1/2, 1, 2, 3 ...
  Shading(int width, int height, double samples);

  // Targets of the passes that others draw, in this order. Each call binds and clears.
  void begin_shadow();
  void begin_scene();
  // Lights what the G-buffer holds; water_light says how much water the light crosses on its way, and caustics
  // what it makes of the light on the floor; each may be 0.
  void light(double light_map_metres, GLuint water_light = 0, GLuint caustics = 0);
  // Water over what was lit: its thickness, then its surface, into targets that each call binds and clears, then the
  // light on it. `size` is the domain's diagonal in m, to which the theme's absorption refers.
  void begin_water_thickness();
  void begin_water();
  void light_water(const Theme& theme, double size);
  // Brings the picture to its own size and binds it, with blending on, for walls and legend to be drawn over it.
  void finish();

  int drawn_width() const { return drawn(width_); }
  int drawn_height() const { return drawn(height_); }
  double samples() const { return samples_; }
  int shadow_size() const { return samples_ < 1 ? 512 : 1024; }

  GLuint picture() const { return picture_; }
  GLuint picture_target() const { return picture_target_; }
  GLuint depth() const { return depth_; }
  GLuint scene_target() const { return scene_target_; }
  GLuint shadow_map() const { return shadow_map_; }

 private:
  void make_water_targets();
  void full_screen(const gl::Program& program, GLuint target, int width, int height);

  int drawn(int pixels) const { return std::max(1, static_cast<int>(std::ceil(samples_ * pixels))); }

  int width_, height_;
  double samples_;
  gl::VertexArray nothing_;
  gl::Program distance_program_, smooth_program_, occlusion_program_, blur_program_, shade_program_, resolve_program_;
  gl::Program water_program_;
  gl::Texture shadow_map_, depth_, albedo_, normal_;                                           // of the drawn size
  gl::Texture distance_, smoothed_across_, smoothed_, light_, light_blurred_, smooth_normal_;  // half of it
  gl::Texture shaded_, picture_;
  // Made for the first picture with water.
  gl::Texture water_thickness_, water_normal_, with_water_;
  gl::Framebuffer water_thickness_target_, water_target_, with_water_target_;
  bool has_water_ = false;  // the picture in hand
  gl::Framebuffer shadow_target_, scene_target_, distance_target_, across_target_, smoothed_target_, occlusion_target_,
      blur_target_, shade_target_, picture_target_;
};

}  // namespace curlew
