// OpenGL names that are deleted with their owners, and the few ways in which we make them.
#pragma once

#include <glad/gl.h>

#include <cstddef>
#include <span>
#include <utility>

#include "render/image.h"

namespace curlew::gl {

enum class Kind { buffer, texture, framebuffer, vertex_array, sampler, program };

void destroy(Kind kind, GLuint name);

// Owns one OpenGL name. The context must still be current when it goes.
template <Kind kind>
class Object {
 public:
  Object() = default;
  explicit Object(GLuint name) : name_(name) {}
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Object() {
    if (name_) destroy(kind, name_);
  }
  operator GLuint() const { return name_; }

 private:
  GLuint name_ = 0;
};

using Texture = Object<Kind::texture>;
using Framebuffer = Object<Kind::framebuffer>;
using VertexArray = Object<Kind::vertex_array>;
using Program = Object<Kind::program>;
using Sampler = Object<Kind::sampler>;

// A buffer that grows: sizes change from frame to frame where emitters run, storage only when it must.
class Buffer {
 public:
  void upload(const void* data, std::size_t bytes);
  template <class T>
  void upload(std::span<const T> data) {
    upload(data.data(), data.size_bytes());
  }
  GLuint name() const { return object_; }

 private:
  Object<Kind::buffer> object_;
  std::size_t capacity_ = 0;
};

// Two-dimensional, one level, clamped at its edges.
Texture make_texture(GLenum format, int width, int height, GLenum filter = GL_NEAREST);

// Colour textures in order, and a depth texture where it is not 0. Throws GraphicsError where the driver refuses.
Framebuffer make_framebuffer(std::span<const GLuint> colour, GLuint depth = 0);

VertexArray make_vertex_array();

// Clamped, comparing nothing: for reading a shadow map's depths themselves.
Sampler make_sampler(GLenum filter);

// What a framebuffer holds, first row at the top; `buffer` is GL_BACK for a window's own.
Image read_picture(GLuint framebuffer, int width, int height, GLenum buffer = GL_COLOR_ATTACHMENT0);

}  // namespace curlew::gl
