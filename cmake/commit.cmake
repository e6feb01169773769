# CURLEW_COMMIT: the git commit that was configured, "unknown" outside git.
find_package(Git QUIET)
set(CURLEW_COMMIT unknown)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --short=12 HEAD
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(CURLEW_COMMIT ${commit})
  endif()
  # This log grows with every commit and checkout, and then the configuration runs again.
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --git-path logs/HEAD
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE log OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET RESULT_VARIABLE failed)
  get_filename_component(log "${log}" ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT failed AND EXISTS ${log})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${log})
  endif()
endif()

# Defines CURLEW_COMMIT for those sources that name it, so that a commit recompiles one file and not the program.
function(curlew_define_commit sources)
  foreach(source IN LISTS sources)
    file(STRINGS ${source} lines REGEX CURLEW_COMMIT LIMIT_COUNT 1)
    if(lines)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS CURLEW_COMMIT="${CURLEW_COMMIT}")
    endif()
  endforeach()
endfunction()
