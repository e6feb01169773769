# cmake -D FOLDER=shaders -D OUTPUT=shaders.cpp -P embed_shaders.cmake
# Writes a .cpp that holds every file below FOLDER and defines curlew::shader_source (render/shaders.h), so that the
# program finds its shaders wherever it stands.
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
list(SORT files)

set(rows "")
list(LENGTH files count)
foreach(name IN LISTS files)
  file(READ ${FOLDER}/${name} text)
  string(APPEND rows "    {\"${name}\", R\"_GLSL_(${text})_GLSL_\"},\n")
endforeach()

file(WRITE ${OUTPUT} "// Generated from shaders/ by cmake/embed_shaders.cmake.
#include \"render/shaders.h\"

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace curlew {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, ${count}> shaders{{
${rows}}};

}  // namespace

std::string_view shader_source(std::string_view name) {
  for (const auto& [file, text] : shaders) {
    if (file == name) return text;
  }
  throw std::out_of_range(\"no shader named '\" + std::string(name) + \"' in shaders/\");
}

}  // namespace curlew
")
