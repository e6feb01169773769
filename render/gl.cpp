#include "render/gl.h"

#include <algorithm>

#include <string>
#include <vector>

#include "sim/core/error.h"

namespace curlew::gl {

void destroy(Kind kind, GLuint name) {
  switch (kind) {
    case Kind::buffer:
      glDeleteBuffers(1, &name);
      break;
    case Kind::texture:
      glDeleteTextures(1, &name);
      break;
    case Kind::framebuffer:
      glDeleteFramebuffers(1, &name);
      break;
    case Kind::vertex_array:
      glDeleteVertexArrays(1, &name);
      break;
    case Kind::sampler:
      glDeleteSamplers(1, &name);
      break;
    case Kind::program:
      glDeleteProgram(name);
      break;
  }
}

void Buffer::upload(const void* data, std::size_t bytes) {
  if (!object_) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    object_ = Object<Kind::buffer>(name);
  }
  if (bytes > capacity_ || capacity_ == 0) {
    capacity_ = bytes + bytes / 4 + 16;  // never empty: some drivers refuse to bind a buffer of no bytes
    glNamedBufferData(object_, static_cast<GLsizeiptr>(capacity_), nullptr, GL_DYNAMIC_DRAW);
  }
  if (bytes > 0) glNamedBufferSubData(object_, 0, static_cast<GLsizeiptr>(bytes), data);
}

Texture make_texture(GLenum format, int width, int height, GLenum filter) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  Texture texture(name);
  glTextureStorage2D(texture, 1, format, width, height);
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter));
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter));
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

Framebuffer make_framebuffer(std::span<const GLuint> colour, GLuint depth) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer(name);
  std::vector<GLenum> targets;
  for (const GLuint texture : colour) {
    targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
    glNamedFramebufferTexture(framebuffer, targets.back(), texture, 0);
  }
  if (depth) glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
  if (targets.empty())
    glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
  else
    glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(targets.size()), targets.data());
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw GraphicsError("the OpenGL driver refuses a drawing target (status " + std::to_string(status) +
                        "): it lacks a texture format of OpenGL 4.5");
  return framebuffer;
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

Sampler make_sampler(GLenum filter) {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  Sampler sampler(name);
  glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(filter));
  glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter));
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return sampler;
}

Image read_picture(GLuint framebuffer, int width, int height, GLenum buffer) {
  Image upside_down(width, height), image(width, height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glReadBuffer(buffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.rgba.data());
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  for (int y = 0; y < height; ++y) std::copy_n(upside_down.at(0, height - 1 - y), row, image.at(0, y));
  return image;
}

}  // namespace curlew::gl
