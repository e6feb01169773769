#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "render/camera.h"
#include "render/colour_range.h"
#include "render/context.h"
#include "render/drop_size.h"
#include "render/gl.h"
#include "render/in_sight.h"
#include "render/legend.h"
#include "render/overlay.h"
#include "render/particles.h"
#include "render/programs.h"
#include "render/shading.h"
#include "render/solids.h"
#include "render/theme.h"
#include "render/view_block.h"
#include "render/walls.h"
#include "render/water.h"
#include "sim/core/error.h"

namespace curlew {
namespace {

void check_size(int width, int height, int supersample) {
  GLint largest = 0;
  const int most = std::max(supersample, 2);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width < 1 || height < 1 || supersample < 0 || width > largest / most || height > largest / most)
    throw InputError("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                     " pixels cannot be drawn: each side must lie between 1 and " + std::to_string(largest / most));
}

int supersampling(int wanted, int width, int height) {
  if (wanted > 0) return wanted;
  return static_cast<long long>(width) * height <= 640LL * 360 ? 2 : 1;
}

}  // namespace

// Water that is not drawn as spheres.
struct ClearWater {
  const SurfaceMesh* mesh;  // null: from the particles, on the screen
  double radius, fill;      // of a drawn particle in m, and the share of the water in their spheres
};

struct Renderer::State {
  int width, height, wanted_supersample;
  Shading full;
  std::optional<Shading> draft;  // once there was one
  Shading* shading = &full;      // of the last picture
  ParticleLayer particles;
  SolidLayer solids;
  WallLayer walls;
  // Once there was some of it.
  std::optional<WaterLight> water_light;
  std::optional<WaterMeshLayer> water_mesh;
  std::optional<ScreenWaterLayer> screen_water;
  Overlay overlay;
  gl::Program shadow_program;
  gl::Buffer block;
  View view;

  State(int w, int h, int n)
      : width(w),
        height(h),
        wanted_supersample(n),
        full(w, h, supersampling(n, w, h)),
        shadow_program(gl::link_program("shadow.vert", "shadow.frag")) {}

  void upload_particles(const Frame& frame, const DropSize& size, const LightMap& light, bool only_in_sight);
  void draw_shadow(const LightMap& light, double radius, bool bodies, bool particles_too);
  void draw_scene(const ViewSettings& settings, bool flat, bool particles_too);
  void draw_water_light(const LightMap& light, const ClearWater& water, const Domain& domain);
  void draw_water(const ClearWater& water, const Theme& theme, const FrameGeometry& geometry);
  void draw_legend(const Frame& frame, const Look& look, const Theme& theme, std::array<double, 2> range,
                   bool clear_water);
};

void Renderer::State::upload_particles(const Frame& frame, const DropSize& size, const LightMap& light,
                                       bool only_in_sight) {
  const std::vector<Vec3> sized = sized_particles(frame, size);
  if (!only_in_sight) {
    particles.upload(sized, frame.value);
    return;
  }
  const double spacing = 2 * frame.geometry->particle_radius;
  std::vector<Vec3> seen, lit;
  std::vector<float> values;
  for (const auto i : in_sight(sized, view, spacing)) {
    seen.push_back(sized[i]);
    if (!frame.value.empty()) values.push_back(frame.value[i]);
  }
  for (const auto i : in_sight(sized, light.view, spacing, 1)) lit.push_back(sized[i]);
  particles.upload(seen, values);
  particles.upload_shadow(lit);
}

void Renderer::State::draw_shadow(const LightMap& light, double radius, bool bodies, bool particles_too) {
  const double pixels = 2 * radius / light.metres * shading->shadow_size();
  gl::set(shadow_program, "point_size", static_cast<float>(std::max(1.0, pixels)));
  if (particles_too) particles.draw_shadow(shadow_program);
  if (bodies) solids.draw_shadow(shadow_program);
}

void Renderer::State::draw_water_light(const LightMap& light, const ClearWater& water, const Domain& domain) {
  if (!water_light) water_light.emplace();
  const int w = shading->drawn_width(), h = shading->drawn_height();
  if (water.mesh && !water_mesh) water_mesh.emplace();
  if (water.mesh) water_mesh->upload(*water.mesh);
  if (!water.mesh && (!screen_water || screen_water->width() != w || screen_water->height() != h))
    screen_water.emplace(w, h);
  water_light->begin(shading->shadow_map());
  if (water.mesh)
    water_mesh->draw_light(light, *water_light);
  else
    screen_water->draw_light(particles, light, *water_light, water.radius, water.fill);
  water_light->end();
  if (water.mesh) water_mesh->draw_caustics(domain);
}

// Over the lit picture of the solids.
void Renderer::State::draw_water(const ClearWater& water, const Theme& theme, const FrameGeometry& geometry) {
  shading->begin_water_thickness();
  if (water.mesh) {
    water_mesh->draw_thickness(shading->depth());
    shading->begin_water();
    water_mesh->draw_surface();
  } else {
    screen_water->draw_thickness(particles, shading->depth(), water.fill);
    screen_water->find_distances(particles, 2 * geometry.particle_radius);
    shading->begin_water();
    screen_water->draw_surface();
  }
  shading->light_water(theme, length(geometry.domain.max - geometry.domain.min));
}

void Renderer::State::draw_scene(const ViewSettings& settings, bool flat, bool particles_too) {
  shading->begin_scene();
  if (particles_too) particles.draw();
  if (settings.show_bodies) solids.draw_bodies();
  if (settings.look.show_floor || flat) solids.draw_floor();
}

void Renderer::State::draw_legend(const Frame& frame, const Look& look, const Theme& theme, std::array<double, 2> range,
                                  bool clear_water) {
  overlay.begin(width, height, theme);
  if (!frame.value.empty() && !clear_water)
    add_colour_scale(overlay, width, height, frame.colour, look.colour_map, range);
  add_time(overlay, width, height, frame.time);
  overlay.end();
}

Renderer::Renderer(int width, int height, int supersample) {
  check_size(width, height, supersample);
  state_ = std::make_unique<State>(width, height, supersample);
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

int Renderer::width() const { return state_->width; }
int Renderer::height() const { return state_->height; }
unsigned Renderer::texture() const { return state_->shading->picture(); }

void Renderer::resize(int width, int height) {
  if (width == state_->width && height == state_->height) return;
  check_size(width, height, state_->wanted_supersample);
  state_->full = Shading(width, height, supersampling(state_->wanted_supersample, width, height));
  state_->draft.reset();
  state_->shading = &state_->full;
  state_->width = width;
  state_->height = height;
}

void Renderer::render(const Frame& frame, const ViewSettings& settings, Detail detail) {
  State& s = *state_;
  const bool draft = detail == Detail::draft;
  if (draft && !s.draft) s.draft.emplace(s.width, s.height, 0.5);
  s.shading = draft ? &*s.draft : &s.full;
  const FrameGeometry& geometry = *frame.geometry;
  const Look& look = settings.look;
  const Theme& theme = theme_named(look.background);
  const bool flat = geometry.dimension == 2, coloured = !frame.value.empty();
  const bool clear = !flat && look.style != LookStyle::particles;
  const DropSize size = settings.particle_scale ? DropSize{*settings.particle_scale, *settings.particle_scale}
                        : flat                  ? kDropSize2d
                                                : kDropSize3d;
  const double radius = size.in_water * geometry.particle_radius;
  const std::array<double, 2> range = look.range ? *look.range : colour_range(frame);

  s.view = view_of(settings.camera, geometry.domain, geometry.dimension, static_cast<double>(s.width) / s.height,
                   look.show_legend ? legend_margin(s.width, s.height) : 0.0);
  if (s.view.orthographic) s.view.half_height /= settings.flat_zoom;
  const LightMap light = light_map_of(geometry.domain, key_direction(s.view, geometry.dimension));
  const ViewBlock block = view_block(s.view, theme, geometry, light, radius, s.shading->drawn_width(),
                                     s.shading->drawn_height(), s.shading->samples());
  s.block.upload(&block, sizeof block);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, s.block.name());
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_PROGRAM_POINT_SIZE);

  // Small particles do not cover what lies behind them.
  const bool covering = radius > 0.9 * geometry.particle_radius;
  const double fill = std::numbers::pi / 6 * std::pow(size.in_water, 3);
  const ClearWater water{look.style == LookStyle::water ? frame.surface.get() : nullptr, radius, fill};
  if (!clear || water.mesh == nullptr) {
    s.upload_particles(frame, size, light, draft && !flat && covering && !clear);
    s.particles.set_colours(look.colour_map, theme.water, range, coloured);
  }
  s.solids.upload(frame.geometry, frame.body_offset);
  s.shading->begin_shadow();
  if (!flat) s.draw_shadow(light, radius, settings.show_bodies, !clear);
  if (clear) s.draw_water_light(light, water, geometry.domain);
  s.draw_scene(settings, flat, !clear);
  s.shading->light(light.metres, clear ? s.water_light->map() : 0, water.mesh ? s.water_mesh->caustics() : 0);
  if (clear) s.draw_water(water, theme, geometry);
  s.shading->finish();
  if (look.show_walls) s.walls.draw(geometry, s.view, theme, std::max(1.0, s.height / 600.0), s.shading->depth());
  if (look.show_legend) s.draw_legend(frame, look, theme, range, clear);

  glDisable(GL_BLEND);
  glDisable(GL_PROGRAM_POINT_SIZE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  check_graphics();
}

Image Renderer::read() const {
  return gl::read_picture(state_->shading->picture_target(), state_->width, state_->height);
}

Image Renderer::draw(const Frame& frame, const ViewSettings& settings) {
  render(frame, settings);
  return read();
}

std::optional<Vec3d> Renderer::point_at(int x, int y) const {
  const State& s = *state_;
  if (x < 0 || y < 0 || x >= s.width || y >= s.height) return std::nullopt;
  const double n = s.shading->samples();
  const int px = static_cast<int>(n * (x + 0.5)), py = static_cast<int>(n * (s.height - 0.5 - y));
  float depth = 0;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, s.shading->scene_target());
  glReadPixels(px, py, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  if (depth == 0) return std::nullopt;

  const View& v = s.view;
  const double d = static_cast<double>(depth);
  const double distance =
      v.orthographic ? v.far - d * (v.far - v.near) : 1 / (1 / v.far + d * (v.far - v.near) / (v.near * v.far));
  const double scale = v.half_height * (v.orthographic ? 1 : distance);
  const double across = 2 * (px + 0.5) / s.shading->drawn_width() - 1,
               up = 2 * (py + 0.5) / s.shading->drawn_height() - 1;
  return v.position + distance * v.forward + across * v.aspect * scale * v.right + up * scale * v.up;
}

}  // namespace curlew
