#include "render/shading.h"

#include <algorithm>
#include <array>

#include "render/programs.h"

namespace curlew {
namespace {

int half(int pixels) { return std::max(1, (pixels + 1) / 2); }

}  // namespace

Shading::Shading(int width, int height, double samples)
    : width_(width),
      height_(height),
      samples_(samples),
      nothing_(gl::make_vertex_array()),
      distance_program_(gl::link_program("fullscreen.vert", "distance.frag")),
      smooth_program_(gl::link_program("fullscreen.vert", "smooth.frag")),
      occlusion_program_(gl::link_program("fullscreen.vert", "occlusion.frag")),
      blur_program_(gl::link_program("fullscreen.vert", "blur.frag")),
      shade_program_(gl::link_program("fullscreen.vert", "shade.frag")),
      resolve_program_(gl::link_program("fullscreen.vert", samples < 1 ? "enlarge.frag" : "resolve.frag")) {
  const int w = drawn_width(), h = drawn_height(), hw = half(w), hh = half(h);
  shadow_map_ = gl::make_texture(GL_DEPTH_COMPONENT32F, shadow_size(), shadow_size(), GL_LINEAR);
  glTextureParameteri(shadow_map_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  depth_ = gl::make_texture(GL_DEPTH_COMPONENT32F, w, h);
  albedo_ = gl::make_texture(GL_RGBA8, w, h);
  normal_ = gl::make_texture(GL_RGB10_A2, w, h);
  distance_ = gl::make_texture(GL_RG32F, hw, hh);
  smoothed_across_ = gl::make_texture(GL_RG32F, hw, hh);
  smoothed_ = gl::make_texture(GL_RG32F, hw, hh);
  light_ = gl::make_texture(GL_RG8, hw, hh);
  light_blurred_ = gl::make_texture(GL_RG8, hw, hh);
  smooth_normal_ = gl::make_texture(GL_RGB10_A2, hw, hh);
  shaded_ = gl::make_texture(GL_RGBA8, w, h, GL_LINEAR);
  picture_ = gl::make_texture(GL_RGBA8, width_, height_, GL_LINEAR);

  const auto target = [](std::initializer_list<GLuint> colour, GLuint depth = 0) {
    return gl::make_framebuffer(std::span<const GLuint>(colour.begin(), colour.size()), depth);
  };
  shadow_target_ = target({}, shadow_map_);
  scene_target_ = target({albedo_, normal_}, depth_);
  distance_target_ = target({distance_});
  across_target_ = target({smoothed_across_});
  smoothed_target_ = target({smoothed_});
  occlusion_target_ = target({light_, smooth_normal_});
  blur_target_ = target({light_blurred_});
  shade_target_ = target({shaded_});
  picture_target_ = target({picture_});
}

void Shading::begin_shadow() {
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
  glViewport(0, 0, shadow_size(), shadow_size());
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  const float farthest = 1;
  glClearNamedFramebufferfv(shadow_target_, GL_DEPTH, 0, &farthest);
}

void Shading::begin_scene() {
  has_water_ = false;
  glBindFramebuffer(GL_FRAMEBUFFER, scene_target_);
  glViewport(0, 0, drawn_width(), drawn_height());
  glDepthFunc(GL_GREATER);
  const float farthest = 0;
  const std::array<float, 4> nothing{};
  glClearNamedFramebufferfv(scene_target_, GL_DEPTH, 0, &farthest);
  glClearNamedFramebufferfv(scene_target_, GL_COLOR, 0, nothing.data());
  glClearNamedFramebufferfv(scene_target_, GL_COLOR, 1, nothing.data());
}

void Shading::full_screen(const gl::Program& program, GLuint target, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, width, height);
  glUseProgram(program);
  glBindVertexArray(nothing_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Shading::light(double light_map_metres, GLuint water_light, GLuint caustics) {
  const int w = drawn_width(), h = drawn_height(), hw = half(w), hh = half(h);
  glDisable(GL_DEPTH_TEST);
  const auto sources = [](std::initializer_list<GLuint> textures) {
    glBindTextures(0, static_cast<GLsizei>(textures.size()), textures.begin());
  };

  sources({depth_, albedo_});
  full_screen(distance_program_, distance_target_, hw, hh);
  for (const float fill : {0.f, 1.f}) {
    sources({fill == 0 ? distance_ : smoothed_});
    gl::set(smooth_program_, "axis", 1, 0, fill, 0);
    full_screen(smooth_program_, across_target_, hw, hh);
    sources({smoothed_across_});
    gl::set(smooth_program_, "axis", 0, 1, fill, 0);
    full_screen(smooth_program_, smoothed_target_, hw, hh);
  }

  // The lamp is a disc: its shadows' edges are a hundredth of the domain wide.
  const float texel = static_cast<float>(light_map_metres / shadow_size());
  const float part = 1 / static_cast<float>(shadow_size());
  gl::set(occlusion_program_, "light_texel", part, part, texel, 0.006f);
  sources({smoothed_, normal_, shadow_map_});
  full_screen(occlusion_program_, occlusion_target_, hw, hh);
  sources({light_, smoothed_});
  full_screen(blur_program_, blur_target_, hw, hh);

  gl::set(shade_program_, "light_through_water", water_light != 0 ? 1.f : 0.f);
  gl::set(shade_program_, "has_caustics", caustics != 0 ? 1.f : 0.f);
  sources({depth_, albedo_, normal_, light_blurred_, smooth_normal_, smoothed_, water_light, caustics});
  full_screen(shade_program_, shade_target_, w, h);
}

void Shading::make_water_targets() {
  if (water_thickness_) return;
  const int w = drawn_width(), h = drawn_height();
  water_program_ = gl::link_program("fullscreen.vert", "water.frag");
  water_thickness_ = gl::make_texture(GL_R32F, w, h, GL_LINEAR);
  water_normal_ = gl::make_texture(GL_RGB10_A2, w, h);
  with_water_ = gl::make_texture(GL_RGBA8, w, h, GL_LINEAR);
  const std::array<GLuint, 3> colour{water_thickness_, water_normal_, with_water_};
  water_thickness_target_ = gl::make_framebuffer({&colour[0], 1});
  water_target_ = gl::make_framebuffer({&colour[1], 1}, depth_);
  with_water_target_ = gl::make_framebuffer({&colour[2], 1});
}

void Shading::begin_water_thickness() {
  make_water_targets();
  glBindFramebuffer(GL_FRAMEBUFFER, water_thickness_target_);
  glViewport(0, 0, drawn_width(), drawn_height());
  const std::array<float, 4> nothing{};
  glClearNamedFramebufferfv(water_thickness_target_, GL_COLOR, 0, nothing.data());
}

void Shading::begin_water() {
  make_water_targets();
  glBindFramebuffer(GL_FRAMEBUFFER, water_target_);
  glViewport(0, 0, drawn_width(), drawn_height());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  const std::array<float, 4> nothing{};
  glClearNamedFramebufferfv(water_target_, GL_COLOR, 0, nothing.data());
}

void Shading::light_water(const Theme& theme, double size) {
  glDisable(GL_DEPTH_TEST);
  const auto colour = [&](const char* name, const Colour& c, double factor = 1) {
    const auto f = static_cast<float>(factor);
    gl::set(water_program_, name, f * c[0], f * c[1], f * c[2], 0);
  };
  colour("deep_colour", theme.deep_water);
  colour("absorption", theme.absorption, 1 / size);
  colour("sky_zenith", theme.sky_zenith);
  colour("sky_horizon", theme.sky_horizon);
  const std::array<GLuint, 5> sources{shaded_, depth_, water_normal_, water_thickness_, distance_};
  glBindTextures(0, static_cast<GLsizei>(sources.size()), sources.data());
  full_screen(water_program_, with_water_target_, drawn_width(), drawn_height());
  has_water_ = true;
}

void Shading::finish() {
  glDisable(GL_DEPTH_TEST);
  const std::array<GLuint, 3> sources{has_water_ ? with_water_ : shaded_, albedo_, normal_};
  glBindTextures(0, static_cast<GLsizei>(sources.size()), sources.data());
  full_screen(resolve_program_, picture_target_, width_, height_);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

}  // namespace curlew
