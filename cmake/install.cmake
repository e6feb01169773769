# The solver as a CMake package, find_package(curlew) and curlew::sim, and the program with its assets.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/curlew)

if(TARGET curlew_sim)
  install(TARGETS curlew_sim EXPORT curlewTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY sim DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/curlew FILES_MATCHING PATTERN "*.h")
  install(EXPORT curlewTargets NAMESPACE curlew:: DESTINATION ${package_folder})
  configure_package_config_file(cmake/curlewConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/curlewConfig.cmake
    INSTALL_DESTINATION ${package_folder})
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/curlewConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/curlewConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/curlewConfigVersion.cmake
    DESTINATION ${package_folder})
endif()

if(TARGET curlew)
  install(TARGETS curlew RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # The program looks for ../share/curlew beside itself, whatever the prefix.
  install(DIRECTORY assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/curlew)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()
