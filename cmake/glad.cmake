# curlew_glad: the loader of OpenGL 4.5 core, written at build time by glad 2 and never committed. Extensions are
# named, because all of them would make 1.5 MB of source; --reproducible keeps the generator off the network.
set(glad_folder ${CMAKE_CURRENT_BINARY_DIR}/generated/glad)
set(glad_extensions GL_KHR_debug,GL_EXT_texture_filter_anisotropic)
add_custom_command(
  OUTPUT ${glad_folder}/src/gl.c ${glad_folder}/include/glad/gl.h ${glad_folder}/include/KHR/khrplatform.h
  COMMAND ${CURLEW_GLAD} --api gl:core=4.5 --extensions ${glad_extensions} --reproducible --quiet
          --out-path ${glad_folder} c
  COMMENT "Generating the OpenGL loader"
  VERBATIM)
add_library(curlew_glad STATIC ${glad_folder}/src/gl.c ${glad_folder}/include/glad/gl.h)
target_include_directories(curlew_glad SYSTEM PUBLIC ${glad_folder}/include)
target_compile_options(curlew_glad PRIVATE -w)  # Not our code, so not our warnings.
