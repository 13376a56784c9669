# What find_package(isoglass) needs: the exported rooms, and their dependencies looked up again.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/isoglass")
configure_package_config_file(cmake/isoglassConfig.cmake.in "${PROJECT_BINARY_DIR}/isoglassConfig.cmake"
  INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/isoglassConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/isoglassConfig.cmake" "${PROJECT_BINARY_DIR}/isoglassConfigVersion.cmake"
  cmake/Dependencies.cmake DESTINATION "${package_folder}")
install(EXPORT isoglass NAMESPACE isoglass:: FILE isoglassTargets.cmake DESTINATION "${package_folder}")
