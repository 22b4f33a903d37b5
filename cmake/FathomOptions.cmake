# How every target of ours is compiled.
#
# -ffp-contract=off: the error bounds and the oracles assume that a * b + c is rounded twice unless
# std::fma is written. fast-math is never used. Flags are private, so users of fathom::fathom keep theirs.
include(GNUInstallDirs)

function(fathom_target_options target)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow
                                           -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
                                           # designated initializers leave out what has a default
                                           -Wno-missing-field-initializers)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms on string concatenation: https://gcc.gnu.org/PR105651.
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(FATHOM_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(FATHOM_SANITIZERS)
    target_compile_options(${target} PRIVATE -fsanitize=${FATHOM_SANITIZERS}
                                             -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${FATHOM_SANITIZERS})
    # Tests do less, or do without limits on memory, where this is defined.
    target_compile_definitions(${target} PRIVATE FATHOM_SANITIZED)
  endif()
endfunction()

# A room of the library: fathom_<room>, exported as fathom::<room>.
function(fathom_room room)
  cmake_parse_arguments(ROOM "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  add_library(fathom_${room} STATIC ${ROOM_SOURCES} ${ROOM_HEADERS})
  add_library(fathom::${room} ALIAS fathom_${room})
  set_target_properties(fathom_${room} PROPERTIES EXPORT_NAME ${room})
  target_compile_features(fathom_${room} PUBLIC cxx_std_20)
  target_include_directories(fathom_${room} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>"
                                                   "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(fathom_${room} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
  fathom_target_options(fathom_${room})
  install(TARGETS fathom_${room} EXPORT FathomTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(FILES ${ROOM_HEADERS} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/fathom/${room}")
endfunction()
