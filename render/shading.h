// Everything after the G-buffer: smoothing, occlusion, light, and the way to the final picture. Owns all targets.
#pragma once

#include <algorithm>
#include <cmath>

#include "render/gl.h"

namespace curlew {

class Shading {
 public:
  // samples: drawn pixels for each one of the picture, along one side: 1/2, 1, 2, 3 ...
  Shading(int width, int height, double samples);

  // Targets of the passes that others draw, in this order. Each call binds and clears.
  void begin_shadow();
  void begin_scene();
  // Lights what the G-buffer holds, brings the picture to its own size and binds it, with blending on, for walls and
  // legend to be drawn over it.
  void light(double light_map_metres);

  int drawn_width() const { return drawn(width_); }
  int drawn_height() const { return drawn(height_); }
  double samples() const { return samples_; }
  int shadow_size() const { return samples_ < 1 ? 512 : 1024; }

  GLuint picture() const { return picture_; }
  GLuint picture_target() const { return picture_target_; }
  GLuint depth() const { return depth_; }
  GLuint scene_target() const { return scene_target_; }

 private:
  void full_screen(const gl::Program& program, GLuint target, int width, int height);

  int drawn(int pixels) const { return std::max(1, static_cast<int>(std::ceil(samples_ * pixels))); }

  int width_, height_;
  double samples_;
  gl::VertexArray nothing_;
  gl::Program distance_program_, smooth_program_, occlusion_program_, blur_program_, shade_program_, resolve_program_;
  gl::Texture shadow_map_, depth_, albedo_, normal_;                                           // of the drawn size
  gl::Texture distance_, smoothed_across_, smoothed_, light_, light_blurred_, smooth_normal_;  // half of it
  gl::Texture shaded_, picture_;
  gl::Framebuffer shadow_target_, scene_target_, distance_target_, across_target_, smoothed_target_, occlusion_target_,
      blur_target_, shade_target_, picture_target_;
};

}  // namespace curlew
