# How every target of ours is compiled.
#
# -ffp-contract=off: the error bounds and the oracles assume that a * b + c is rounded twice unless
# std::fma is written. fast-math is never used. Flags are private, so users of fathom::fathom keep theirs.
#
# -fno-tree-slp-vectorize: GCC 12 at -O3, packing neighbouring statements, drops conversions to float and back
# to double, so that what should be rounded is not (tests/numeric/narrowing_test.cpp). Loops that gain by vector
# instructions are written with them.
include(GNUInstallDirs)

# What keeps a mistake of ours from becoming the execution of someone else's code: canaries on the stack,
# checked calls of the C library, tables of addresses that are read-only before main() starts, checked
# indices of the standard library. Sanitizers see more and have functions of their own in its place.
option(FATHOM_HARDENING "Compile and link with the compiler's protections" ON)
set(FATHOM_UNCHECKED "_(numeric|geometry|mesh|triangle|fast|area|unchecked_headers)$")
function(fathom_harden target)
  if(NOT FATHOM_HARDENING OR FATHOM_SANITIZERS)
    return()
  endif()
  target_compile_options(${target} PRIVATE -fstack-clash-protection)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(${target} PRIVATE -fcf-protection)
  endif()
  # Where all time is spent, only functions with arrays have canaries, and indices go unchecked: with them,
  # reading takes 3 % longer, and a render with areas 2 %.
  if(target MATCHES "${FATHOM_UNCHECKED}")
    target_compile_options(${target} PRIVATE -fstack-protector)
  else()
    target_compile_options(${target} PRIVATE -fstack-protector-strong)
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  endif()
  # The C library checks nothing without optimisation, and says so with a warning.
  get_target_property(unoptimised ${target} FATHOM_UNOPTIMISED)
  if(NOT unoptimised)
    target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE>
                                             $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
  endif()
  target_link_options(${target} PRIVATE -Wl,-z,relro,-z,now)
endfunction()

# The headers of the standard library that nearly all sources include, compiled once for each set of options: for the
# libraries of this folder and its subfolders, for those whose indices go unchecked, and for those at -O1. GCC compiles
# the functions of these headers with the options that the headers had, not with the library's own.
#   fathom_precompiled_headers(PREFIX)
function(fathom_precompiled_headers prefix)
  foreach(kind headers unchecked_headers light_headers)
    set(target ${prefix}_${kind})
    file(CONFIGURE OUTPUT ${target}.cpp CONTENT "// Carries precompiled headers.\n")
    add_library(${target} OBJECT "${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp")
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
    target_compile_features(${target} PUBLIC cxx_std_20)
    if(kind STREQUAL light_headers)
      fathom_optimise_lightly(${target})
    endif()
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <bit> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <optional> <span>
      <string> <string_view> <utility> <variant> <vector>)
    fathom_target_options(${target})
  endforeach()
  set(FATHOM_PRECOMPILED ${prefix} PARENT_SCOPE)
endfunction()

# Compiles a target at -O1 in a release: it takes no time that a higher level would save, and much to compile at one.
function(fathom_optimise_lightly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(${target} PROPERTIES FATHOM_LIGHT ON)
endfunction()

# Compiles a target at -O0: what it does itself takes less time than a higher level needs.
function(fathom_optimise_not target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O0>)
  set_target_properties(${target} PROPERTIES FATHOM_UNOPTIMISED ON)
endfunction()

# Compiles sources of a light target, in which time is spent, like those of the other targets; their indices go unchecked.
#   fathom_optimise_fully(a.cpp…)
function(fathom_optimise_fully)
  set_source_files_properties(${ARGN} PROPERTIES
    COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-U_GLIBCXX_ASSERTIONS"
    SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# Lets a library use them. Without unity builds, which tools that are not GCC ask for, each source reads its own headers.
function(fathom_precompile target)
  get_target_property(type ${target} TYPE)
  get_target_property(own ${target} PRECOMPILE_HEADERS)
  get_target_property(reused ${target} PRECOMPILE_HEADERS_REUSE_FROM)
  if(NOT FATHOM_UNITY OR NOT FATHOM_PRECOMPILED OR own OR reused OR NOT type MATCHES "STATIC|OBJECT")
    return()
  endif()
  get_target_property(light ${target} FATHOM_LIGHT)
  if(light)
    target_precompile_headers(${target} REUSE_FROM ${FATHOM_PRECOMPILED}_light_headers)
  elseif(target MATCHES "${FATHOM_UNCHECKED}")
    target_precompile_headers(${target} REUSE_FROM ${FATHOM_PRECOMPILED}_unchecked_headers)
  else()
    target_precompile_headers(${target} REUSE_FROM ${FATHOM_PRECOMPILED}_headers)
  endif()
endfunction()

function(fathom_target_options target)
  fathom_harden(${target})
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow
                                           -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
                                           # designated initializers leave out what has a default
                                           -Wno-missing-field-initializers)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms on string concatenation, and on headers that are precompiled: https://gcc.gnu.org/PR105651.
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # -fpch-preprocess: or else ccache passes over what uses precompiled headers.
    # ggc-min-heapsize, in KiB: GCC frees memory of its own from there on, not before; a tenth of the time.
    target_compile_options(${target} PRIVATE -fno-tree-slp-vectorize -fpch-preprocess --param=ggc-min-heapsize=524288)
  endif()
  # Unity builds stay for the user's first build: a few large compilations read the headers of the standard library,
  # Eigen and CGAL once instead of up to eight times. Their price: names in anonymous namespaces are unique in a target.
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FATHOM_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  fathom_precompile(${target})
  if(FATHOM_UNITY AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # It would complain of names of the other sources; GCC sees what is shadowed within one.
    target_compile_options(${target} PRIVATE -Wno-shadow)
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

# Compiles vector code for half of Highway's targets in a build with sanitizers: two, four and eight lanes. The others would
# differ in instructions, not in what they touch, and take a minute to compile each.
function(fathom_vector_targets target)
  if(FATHOM_SANITIZERS)
    target_compile_definitions(${target} PRIVATE "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3_DL)")
  endif()
endfunction()

# Makes the source OUTPUT in the build folder of texts of this folder: a std::string_view for each, named after it.
#   fathom_embed_texts(OUTPUT HEADER NAMESPACE file…)
# HEADER declares them, in NAMESPACE.
function(fathom_embed_texts output header namespace)
  set(files ${ARGN})
  list(TRANSFORM files PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  set(script "${PROJECT_SOURCE_DIR}/cmake/EmbedTexts.cmake")
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${files}" -DHEADER=${header} -DNAMESPACE=${namespace} -DOUTPUT=${output}
            -P "${script}"
    DEPENDS ${files} "${script}" VERBATIM)
endfunction()

# A room of the library, lib/fathom/ROOM: fathom_ROOM, exported as fathom::ROOM.
#   fathom_room(ROOM HEADERS a.h… SOURCES b.cpp… [LIGHT] [STAGES folder…] [USES room…] [PUBLIC|PRIVATE library…])
# HEADERS are what users may include; they are installed. USES names the rooms, defined before, that
# may be included and are linked: the build fails where a file of the room includes another. STAGES
# names the folders of the room from the lowest on: it fails, too, where a file of one includes one of a
# later folder, or of the room's own, which may include all. LIGHT: see fathom_optimise_lightly.
function(fathom_room room)
  cmake_parse_arguments(ROOM "LIGHT" "" "SOURCES;HEADERS;STAGES;USES;PUBLIC;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" name "${room}")
  set(used ${ROOM_USES})
  list(TRANSFORM used REPLACE "/" "_")
  list(TRANSFORM used PREPEND fathom_)
  foreach(target ${used})
    if(NOT TARGET ${target})
      message(FATAL_ERROR "the room ${room} uses ${target}, which is not defined before it")
    endif()
  endforeach()
  add_library(fathom_${name} STATIC ${ROOM_SOURCES} ${ROOM_HEADERS})
  add_library(fathom::${name} ALIAS fathom_${name})
  set_target_properties(fathom_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_compile_features(fathom_${name} PUBLIC cxx_std_20)
  target_include_directories(fathom_${name} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>"
                                                   "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_link_libraries(fathom_${name} PUBLIC ${used} ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
  if(ROOM_LIGHT)
    fathom_optimise_lightly(fathom_${name})
  endif()
  fathom_target_options(fathom_${name})
  install(TARGETS fathom_${name} EXPORT FathomTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  foreach(header ${ROOM_HEADERS})
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/fathom/${room}/${folder}")
  endforeach()

  file(GLOB_RECURSE files CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.h" "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  add_custom_command(OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/room.checked"
    COMMAND ${CMAKE_COMMAND} "-DROOM=${room}" "-DUSES=${ROOM_USES}" "-DSTAGES=${ROOM_STAGES}" "-DFOLDER=${CMAKE_CURRENT_SOURCE_DIR}"
            -P "${PROJECT_SOURCE_DIR}/cmake/CheckRoom.cmake"
    COMMAND ${CMAKE_COMMAND} -E touch "${CMAKE_CURRENT_BINARY_DIR}/room.checked"
    DEPENDS ${files} "${PROJECT_SOURCE_DIR}/cmake/CheckRoom.cmake"
    COMMENT "Checking what ${room} includes" VERBATIM)
  add_custom_target(fathom_${name}_includes DEPENDS "${CMAKE_CURRENT_BINARY_DIR}/room.checked")
  add_dependencies(fathom_${name} fathom_${name}_includes)
endfunction()
