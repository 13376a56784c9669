# A room is one small library that sees only the headers of the rooms it links.
#
#   isoglass_room(NAME  SOURCES file...  [USES room...]  [PRIVATE_USES room...]
#                 [LIBRARIES target...]  [PRIVATE_LIBRARIES target...]  [ALLOW gl|openvdb ...])
#
# Headers are reached as "room/header.h" through a link in the build tree that holds that room
# alone, so including a room that is not linked does not compile. Debian keeps GL and OpenVDB on
# the compiler's default path; rooms that do not ALLOW them find a header with #error first.
function(isoglass_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;PRIVATE_USES;LIBRARIES;PRIVATE_LIBRARIES;ALLOW" ${ARGN})
  set(target isoglass_${name})
  set(view "${PROJECT_BINARY_DIR}/rooms/${name}")
  file(MAKE_DIRECTORY "${view}")
  file(CREATE_LINK "${CMAKE_CURRENT_SOURCE_DIR}" "${view}/${name}" SYMBOLIC)

  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(isoglass::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC "${view}")
  foreach(thing gl openvdb)
    if(NOT thing IN_LIST ROOM_ALLOW)
      target_include_directories(${target} BEFORE PRIVATE "${PROJECT_SOURCE_DIR}/cmake/forbid/${thing}")
    endif()
  endforeach()
  list(TRANSFORM ROOM_USES PREPEND "isoglass::")
  list(TRANSFORM ROOM_PRIVATE_USES PREPEND "isoglass::")
  target_link_libraries(${target}
    PUBLIC ${ROOM_USES} ${ROOM_LIBRARIES}
    PRIVATE ${ROOM_PRIVATE_USES} ${ROOM_PRIVATE_LIBRARIES} isoglass_build_flags)
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
