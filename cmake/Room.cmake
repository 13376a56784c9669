# A room is one small library that sees only the headers of the rooms it links.
#
#   isoglass_room(NAME  SOURCES file...  [USES room...]  [PRIVATE_USES room...]
#                 [LIBRARIES target...]  [PRIVATE_LIBRARIES target...]  [ALLOW gl|openvdb ...]  [INTERNAL])
#
# Headers are reached as "room/header.h" through a link in the build tree that holds that room
# alone, so including a room that is not linked does not compile. Debian keeps GL and OpenVDB on
# the compiler's default path; rooms that do not ALLOW them find a header with #error first.
#
# Rooms are installed with their headers, but for INTERNAL rooms and headers that call themselves "Private
# to the room"; other programs reach them as isoglass::NAME after find_package(isoglass).
include(GNUInstallDirs)

function(isoglass_room name)
  cmake_parse_arguments(ROOM "INTERNAL" "" "SOURCES;USES;PRIVATE_USES;LIBRARIES;PRIVATE_LIBRARIES;ALLOW" ${ARGN})
  set(target isoglass_${name})
  set(view "${PROJECT_BINARY_DIR}/rooms/${name}")
  file(MAKE_DIRECTORY "${view}")
  file(CREATE_LINK "${CMAKE_CURRENT_SOURCE_DIR}" "${view}/${name}" SYMBOLIC)

  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(isoglass::${name} ALIAS ${target})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    "$<BUILD_INTERFACE:${view}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/isoglass>")
  foreach(thing gl openvdb)
    if(NOT thing IN_LIST ROOM_ALLOW)
      target_include_directories(${target} BEFORE PRIVATE "${PROJECT_SOURCE_DIR}/cmake/forbid/${thing}")
    endif()
  endforeach()
  list(TRANSFORM ROOM_USES PREPEND "isoglass::")
  list(TRANSFORM ROOM_PRIVATE_USES PREPEND "isoglass::")
  target_link_libraries(${target}
    PUBLIC ${ROOM_USES} ${ROOM_LIBRARIES}
    PRIVATE ${ROOM_PRIVATE_USES} ${ROOM_PRIVATE_LIBRARIES} $<BUILD_INTERFACE:isoglass_build_flags>)
  if(NOT ROOM_INTERNAL)
    isoglass_install_room(${name})
  endif()
endfunction()

function(isoglass_install_room name)
  set_target_properties(isoglass_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS isoglass_${name} EXPORT isoglass ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}/isoglass")
  file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.h")
  foreach(header IN LISTS headers)
    file(STRINGS "${header}" private REGEX "Private to the room")
    if(NOT private)
      install(FILES "${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/isoglass/${name}")
    endif()
  endforeach()
endfunction()

# Flags of the project's own code. Contracted multiply-adds would make the same expression give
# different bits in different places, and the surface would crack.
add_library(isoglass_build_flags INTERFACE)
target_compile_options(isoglass_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off
  # GCC 12 warns of overlaps in its own std::string that cannot happen (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(ISOGLASS_SANITIZE)
  add_compile_options(-fsanitize=${ISOGLASS_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ISOGLASS_SANITIZE})
endif()
