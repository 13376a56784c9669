# What the libraries stand on, here and in programs that use them. Everything comes from Debian's packages:
# scripts/packages.txt lists them.
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")

set(Boost_NO_WARN_NEW_VERSIONS ON)
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
# Before OpenVDB: its module defines a part of oneTBB, after which VTK finds the rest inconsistent.
if(ISOGLASS_VTK)
  # VTK's drawing, which a benchmark compares with, links to these; its targets belong to this directory.
  find_package(X11 QUIET)
  find_package(GLEW QUIET)
  find_package(VTK 9.1 QUIET COMPONENTS CommonCore CommonDataModel CommonExecutionModel IOXML IOXMLParser
    OPTIONAL_COMPONENTS FiltersCore RenderingCore RenderingOpenGL2)
  if(NOT VTK_FOUND)
    message(STATUS "VTK was not found: .vti, .pvd and .vti.series cannot be imported (libvtk9-dev)")
    set(ISOGLASS_VTK OFF)
  endif()
endif()
find_package(OpenVDB REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenMesh REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(netcdf REQUIRED IMPORTED_TARGET netcdf)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
find_package(glfw3 REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
