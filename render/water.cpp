#include "render/water.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/programs.h"

namespace curlew {
namespace {

constexpr int light_size = 512, caustics_size = 768;

gl::Framebuffer target_for(GLuint colour, GLuint depth = 0) { return gl::make_framebuffer({&colour, 1}, depth); }

void clear(GLuint target) {
  const std::array<float, 4> nothing{};
  glClearNamedFramebufferfv(target, GL_COLOR, 0, nothing.data());
}

// What is drawn in its life adds up, near or far.
class Adding {
 public:
  Adding() {
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
  }
  ~Adding() {
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
  }
  Adding(const Adding&) = delete;
  Adding& operator=(const Adding&) = delete;
};

}  // namespace

WaterLight::WaterLight()
    : map_(gl::make_texture(GL_R16F, light_size, light_size, GL_LINEAR)),
      target_(target_for(map_)),
      depth_sampler_(gl::make_sampler(GL_NEAREST)) {}

float WaterLight::texel() const { return 1.f / light_size; }
int WaterLight::size() const { return light_size; }

void WaterLight::begin(GLuint solids) {
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glViewport(0, 0, light_size, light_size);
  clear(target_);
  glBindTextureUnit(0, solids);
  glBindSampler(0, depth_sampler_);  // the map's own way of sampling compares
}

void WaterLight::end() { glBindSampler(0, 0); }

WaterMeshLayer::WaterMeshLayer()
    : front_program_(gl::link_program("water.vert", "water_front.frag")),
      thickness_program_(gl::link_program("water.vert", "water_thickness.frag")),
      light_program_(gl::link_program("shadow.vert", "water_light.frag")),
      caustics_program_(gl::link_program("caustics.vert", "caustics.frag")),
      array_(gl::make_vertex_array()),
      caustics_(gl::make_texture(GL_R16F, caustics_size, caustics_size, GL_LINEAR)),
      caustics_target_(target_for(caustics_)) {
  for (const GLuint attribute : {0u, 1u}) {
    glEnableVertexArrayAttrib(array_, attribute);
    glVertexArrayAttribFormat(array_, attribute, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array_, attribute, attribute);
  }
}

void WaterMeshLayer::upload(const SurfaceMesh& mesh) {
  positions_.upload(std::span<const Vec3>(mesh.position));
  normals_.upload(std::span<const Vec3>(mesh.normal));
  indices_.upload(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles));
  count_ = static_cast<GLsizei>(3 * mesh.triangles.size());
}

void WaterMeshLayer::draw(const gl::Program& program) {
  if (count_ == 0) return;
  glUseProgram(program);
  glBindVertexArray(array_);
  glVertexArrayVertexBuffer(array_, 0, positions_.name(), 0, sizeof(Vec3));
  glVertexArrayVertexBuffer(array_, 1, normals_.name(), 0, sizeof(Vec3));
  glVertexArrayElementBuffer(array_, indices_.name());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

void WaterMeshLayer::draw_light(const LightMap& light, const WaterLight& into) {
  const Adding adding;
  gl::set(light_program_, "light_metres", static_cast<float>(light.metres));
  gl::set(light_program_, "light_texel", into.texel());
  draw(light_program_);
}

void WaterMeshLayer::draw_caustics(const Domain& domain) {
  glBindFramebuffer(GL_FRAMEBUFFER, caustics_target_);
  glViewport(0, 0, caustics_size, caustics_size);
  clear(caustics_target_);
  const Vec3d size = domain.max - domain.min;
  gl::set(caustics_program_, "texel_area", static_cast<float>(size.x * size.z / (caustics_size * caustics_size)));
  const Adding adding;
  draw(caustics_program_);
}

void WaterMeshLayer::draw_thickness(GLuint solid_depth) {
  const Adding adding;
  glBindTextureUnit(0, solid_depth);
  draw(thickness_program_);
}

void WaterMeshLayer::draw_surface() { draw(front_program_); }

ScreenWaterLayer::ScreenWaterLayer(int width, int height)
    : width_(width),
      height_(height),
      light_program_(gl::link_program("shadow.vert", "particle_light.frag")),
      thickness_program_(gl::link_program("sphere.vert", "sphere_thickness.frag")),
      distance_program_(gl::link_program("sphere.vert", "sphere_distance.frag")),
      filter_program_(gl::link_program("fullscreen.vert", "narrow_range.frag")),
      surface_program_(gl::link_program("fullscreen.vert", "screen_surface.frag")),
      nothing_(gl::make_vertex_array()),
      depth_(gl::make_texture(GL_DEPTH_COMPONENT32F, width, height)),
      distance_(gl::make_texture(GL_R32F, width, height)),
      other_(gl::make_texture(GL_R32F, width, height)),
      distance_target_(target_for(distance_, depth_)),
      other_target_(target_for(other_)),
      filter_target_(target_for(distance_)) {}

void ScreenWaterLayer::draw_light(ParticleLayer& particles, const LightMap& light, const WaterLight& into,
                                  double radius, double fill) {
  const Adding adding;
  gl::set(light_program_, "light_texel", into.texel());
  gl::set(light_program_, "radius", static_cast<float>(radius));
  gl::set(light_program_, "fill", static_cast<float>(fill));
  gl::set(light_program_, "point_size", static_cast<float>(std::max(1.0, 2 * radius / light.metres * into.size())));
  particles.draw_shadow(light_program_);
}

void ScreenWaterLayer::draw_thickness(ParticleLayer& particles, GLuint solid_depth, double fill) {
  const Adding adding;
  // Spheres drawn larger overlap more, so that the sum is smooth.
  constexpr double larger = 0.8;
  gl::set(thickness_program_, "larger", static_cast<float>(larger));
  gl::set(thickness_program_, "fill", static_cast<float>(fill * std::pow(1 + larger, 3)));
  glBindTextureUnit(1, solid_depth);
  particles.draw(thickness_program_);
}

void ScreenWaterLayer::find_distances(ParticleLayer& particles, double spacing) {
  glBindFramebuffer(GL_FRAMEBUFFER, distance_target_);
  glViewport(0, 0, width_, height_);
  glDepthFunc(GL_GREATER);
  const float farthest = 0;
  glClearNamedFramebufferfv(distance_target_, GL_DEPTH, 0, &farthest);
  clear(distance_target_);
  particles.draw(distance_program_);

  glDisable(GL_DEPTH_TEST);
  glUseProgram(filter_program_);
  glBindVertexArray(nothing_);
  for (const double deviation : {1.1, 0.4}) {  // the second pass fills what the strides of the first left out
    const auto metres = static_cast<float>(deviation * spacing);
    gl::set(filter_program_, "axis", 1, 0, metres, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, other_target_);
    glBindTextureUnit(0, distance_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    gl::set(filter_program_, "axis", 0, 1, metres, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, filter_target_);
    glBindTextureUnit(0, other_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glEnable(GL_DEPTH_TEST);
}

void ScreenWaterLayer::draw_surface() {
  glUseProgram(surface_program_);
  glBindVertexArray(nothing_);
  glBindTextureUnit(0, distance_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace curlew
