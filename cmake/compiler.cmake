# Language, warnings and speed-ups of the build, for every target of this project.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release or RelWithDebInfo" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Particle loops may be vectorized where errno and floating-point traps would forbid it. Never -ffast-math: the state
# has to be the same bits at every number of threads (DESIGN 6), and NaN has to stay visible to the guards.
add_compile_options(-fno-math-errno -fno-trapping-math)

# Sign conversions stay out: gcc leaves them out of -Wconversion, clang would put them in.
add_compile_options(-Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wno-psabi)  # Notes about vector arguments between compiler versions; all of it is built by one.
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    add_compile_options(-Wno-restrict)  # gcc 12 sees overlaps in "text" + std::string that are not there (PR 105651).
  endif()
endif()

if(CURLEW_SANITIZE)
  # Asserts stay on, and -O2 keeps scene tests short enough; g1 is what a stack trace needs.
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")
  set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O2 -g1")
  add_compile_options(-fsanitize=${CURLEW_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${CURLEW_SANITIZE})
endif()

find_program(CURLEW_CCACHE ccache)
mark_as_advanced(CURLEW_CCACHE)
if(CURLEW_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this slackness ccache passes by every file that uses a precompiled header.
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
               ${CURLEW_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
  unset(launcher)
endif()

find_program(CURLEW_MOLD mold)
mark_as_advanced(CURLEW_MOLD)
if(CURLEW_MOLD)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=mold CURLEW_LINKS_WITH_MOLD)
  if(CURLEW_LINKS_WITH_MOLD)
    add_link_options(-fuse-ld=mold)
  endif()
endif()
