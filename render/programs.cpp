#include "render/programs.h"

#include <array>
#include <string>

#include "render/shaders.h"
#include "sim/core/error.h"

namespace curlew::gl {
namespace {

// Deleted after the program is linked: a program keeps what it needs.
struct Shader {
  GLuint name;
  explicit Shader(GLenum type) : name(glCreateShader(type)) {}
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { glDeleteShader(name); }
};

void compile(const Shader& shader, std::string_view file) {
  // #line makes the compiler's messages count from the file's own first line.
  constexpr std::string_view head = "#version 450 core\n";
  constexpr std::string_view line = "\n#line 1\n";
  const std::array<std::string_view, 4> parts{head, shader_source("common.glsl"), line, shader_source(file)};
  std::array<const GLchar*, parts.size()> texts{};
  std::array<GLint, parts.size()> lengths{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    texts[i] = parts[i].data();
    lengths[i] = static_cast<GLint>(parts[i].size());
  }
  glShaderSource(shader.name, static_cast<GLsizei>(parts.size()), texts.data(), lengths.data());
  glCompileShader(shader.name);
  GLint ok = 0;
  glGetShaderiv(shader.name, GL_COMPILE_STATUS, &ok);
  if (ok) return;
  std::array<GLchar, 2048> log{};
  glGetShaderInfoLog(shader.name, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw GraphicsError("the OpenGL driver cannot compile the shader " + std::string(file) + ": " + log.data());
}

GLint location(const Program& program, const char* name) { return glGetUniformLocation(program, name); }

}  // namespace

Program link_program(std::string_view vertex, std::string_view fragment) {
  const Shader vertex_shader(GL_VERTEX_SHADER), fragment_shader(GL_FRAGMENT_SHADER);
  compile(vertex_shader, vertex);
  compile(fragment_shader, fragment);
  Program program(glCreateProgram());
  glAttachShader(program, vertex_shader.name);
  glAttachShader(program, fragment_shader.name);
  glLinkProgram(program);
  GLint ok = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok) return program;
  std::array<GLchar, 2048> log{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw GraphicsError("the OpenGL driver cannot link the shaders " + std::string(vertex) + " and " +
                      std::string(fragment) + ": " + log.data());
}

void set(const Program& program, const char* name, float value) {
  glProgramUniform1f(program, location(program, name), value);
}
void set(const Program& program, const char* name, int value) {
  glProgramUniform1i(program, location(program, name), value);
}
void set(const Program& program, const char* name, float x, float y) {
  glProgramUniform2f(program, location(program, name), x, y);
}
void set(const Program& program, const char* name, float x, float y, float z, float w) {
  glProgramUniform4f(program, location(program, name), x, y, z, w);
}

}  // namespace curlew::gl
