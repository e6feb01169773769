# curlew_shaders: every file of shaders/, and the curlew::shader_source() that finds it by name (render/shaders.h).
curlew_sources(shader_sources "shaders/*")
set(embedded_shaders ${CMAKE_CURRENT_BINARY_DIR}/generated/shaders.cpp)
add_custom_command(
  OUTPUT ${embedded_shaders}
  COMMAND ${CMAKE_COMMAND} -D FOLDER=${CMAKE_CURRENT_SOURCE_DIR}/shaders -D OUTPUT=${embedded_shaders}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_shaders.cmake
  DEPENDS ${shader_sources} cmake/embed_shaders.cmake
  COMMENT "Embedding the shaders"
  VERBATIM)
add_library(curlew_shaders STATIC ${embedded_shaders})
target_include_directories(curlew_shaders PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
