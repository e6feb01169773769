// Water that one sees through. Both ways of drawing it, from a mesh of its surface or from its particles on the screen,
// say the same to Shading::light_water(): how much water lies in each pixel, where its nearest surface is and which way
// that faces.
#pragma once

#include "render/gl.h"
#include "render/particles.h"
#include "render/view_block.h"
#include "sim/surface/surface_mesh.h"

namespace curlew {

// How much water the key light crosses before it meets a solid, seen from the light; metres in the red channel.
class WaterLight {
 public:
  WaterLight();
  // Binds and clears it, everything that is drawn is added up; `solids` is the shadow map, at texture unit 0.
  void begin(GLuint solids);
  void end();
  GLuint map() const { return map_; }
  // For the shaders: one texel, as a share of the side.
  float texel() const;
  int size() const;

 private:
  gl::Texture map_;
  gl::Framebuffer target_;
  gl::Sampler depth_sampler_;
};

// From the mesh.
class WaterMeshLayer {
 public:
  WaterMeshLayer();

  void upload(const SurfaceMesh& mesh);
  void draw_light(const LightMap& light, const WaterLight& into);
  // The key light on the floor, bent by the surface, over what falls there without water; a map over the domain.
  void draw_caustics(const Domain& domain);
  GLuint caustics() const { return caustics_; }
  void draw_thickness(GLuint solid_depth);  // into the target that Shading::begin_water_thickness() binds
  void draw_surface();                      // into that of Shading::begin_water()

 private:
  void draw(const gl::Program& program);

  gl::Program front_program_, thickness_program_, light_program_, caustics_program_;
  gl::VertexArray array_;
  gl::Buffer positions_, normals_, indices_;
  gl::Texture caustics_;
  gl::Framebuffer caustics_target_;
  GLsizei count_ = 0;
};

// From the particles, without a mesh: their spheres' distances are smoothed on the screen (van der Laan, Green & Sainz
// 2009, "Screen space fluid rendering with curvature flow"; Truong & Yuksel 2018).
class ScreenWaterLayer {
 public:
  ScreenWaterLayer(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  // `radius` is that of a drawn particle, `fill` the share of the water's volume in their spheres.
  void draw_light(ParticleLayer& particles, const LightMap& light, const WaterLight& into, double radius, double fill);
  void draw_thickness(ParticleLayer& particles, GLuint solid_depth, double fill);
  void find_distances(ParticleLayer& particles, double spacing);
  void draw_surface();

 private:
  int width_, height_;
  gl::Program light_program_, thickness_program_, distance_program_, filter_program_, surface_program_;
  gl::VertexArray nothing_;
  gl::Texture depth_, distance_, other_;
  gl::Framebuffer distance_target_, other_target_, filter_target_;
};

}  // namespace curlew
