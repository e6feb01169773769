# CURLEW_ISA -> CURLEW_ISA_USED, and -march for every target. `auto` asks the processor of this machine, so a program
# that is to run on other machines is built with the level that they all have.
if(CURLEW_ISA STREQUAL "auto")
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    set(CURLEW_ISA_USED none)
  elseif(CMAKE_CROSSCOMPILING)
    set(CURLEW_ISA_USED x86-64-v2)
  else()
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/generated/has_avx2.cpp
      "int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") ? 0 : 1; }\n")
    try_run(CURLEW_AVX2_RUN CURLEW_AVX2_COMPILED
      ${CMAKE_CURRENT_BINARY_DIR}/generated ${CMAKE_CURRENT_BINARY_DIR}/generated/has_avx2.cpp)
    if(CURLEW_AVX2_COMPILED AND CURLEW_AVX2_RUN EQUAL 0)
      set(CURLEW_ISA_USED x86-64-v3)
    else()
      set(CURLEW_ISA_USED x86-64-v2)
    endif()
  endif()
else()
  set(CURLEW_ISA_USED ${CURLEW_ISA})
endif()

if(NOT CURLEW_ISA_USED MATCHES "^(x86-64-v[234]|native|none)$")
  message(FATAL_ERROR "CURLEW_ISA is '${CURLEW_ISA}'; "
                      "expected auto, x86-64-v2, x86-64-v3, x86-64-v4, native or none.")
endif()
if(NOT CURLEW_ISA_USED STREQUAL "none")
  add_compile_options(-march=${CURLEW_ISA_USED})
endif()
message(STATUS "Instruction set: ${CURLEW_ISA_USED}")
