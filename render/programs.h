// Compiles the GLSL files of shaders/ and sets their uniforms by name.
#pragma once

#include <string_view>

#include "render/gl.h"
#include "render/matrix.h"

namespace curlew::gl {

// A program of shaders/<vertex> and shaders/<fragment>, each with shaders/common.glsl before it. Throws GraphicsError
// with the compiler's own words.
Program link_program(std::string_view vertex, std::string_view fragment);

void set(const Program& program, const char* name, float value);
void set(const Program& program, const char* name, int value);
void set(const Program& program, const char* name, float x, float y);
void set(const Program& program, const char* name, float x, float y, float z, float w);

}  // namespace curlew::gl
