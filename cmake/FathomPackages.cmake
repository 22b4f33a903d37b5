# Debian packages: `cpack` in a build folder, or scripts/package-deb. Each is a component of the installation:
# program (fathom), runtime (libfathom0), devel (libfathom-dev) and python (python3-fathom).
set(FATHOM_PACKAGE_MAINTAINER "Fathom maintainers <maintainers@fathom.example>" CACHE STRING
    "Name and address in Debian packages; scripts/package-deb takes those of DEBFULLNAME and DEBEMAIL")
set(FATHOM_PACKAGE_COMPONENTS program devel)
if(FATHOM_C)
  list(APPEND FATHOM_PACKAGE_COMPONENTS runtime)
endif()
if(FATHOM_PYTHON AND FATHOM_PYTHON_INSTALL_DIR)
  list(APPEND FATHOM_PACKAGE_COMPONENTS python)
endif()
set(FATHOM_PACKAGE_NAME_program fathom)
set(FATHOM_PACKAGE_NAME_runtime "libfathom${PROJECT_VERSION_MAJOR}")
set(FATHOM_PACKAGE_NAME_devel libfathom-dev)
set(FATHOM_PACKAGE_NAME_python python3-fathom)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME fathom)
set(CPACK_PACKAGE_VENDOR Fathom)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_NAME} built using CMake") # the default: each package has its own
set(CPACK_PACKAGE_CONTACT "${FATHOM_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL ${FATHOM_PACKAGE_COMPONENTS})
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
foreach(component ${FATHOM_PACKAGE_COMPONENTS})
  set(CPACK_COMPONENT_${component}_GROUP ${component})
endforeach()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${FATHOM_PACKAGE_MAINTAINER}")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME fathom)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS fonts-dejavu-core) # text in previews
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)    # plots of `fathom study`
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "reference depth-map rasterizer
fathom renders depth and coverage maps of triangle meshes in which every
pixel is the exact value, rounded once. Use it as ground truth for
renderers, sensors and depth formats. It also explains the value of each
pixel.")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME "${FATHOM_PACKAGE_NAME_runtime}")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/debian/triggers")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "reference depth-map rasterizer (C library)
The shared library that programs link that render exact depth maps from C,
or from a language that calls C.")

# Rooms are static libraries: what they are built with is needed to link them (cmake/FathomConfig.cmake.in).
set(CPACK_DEBIAN_DEVEL_PACKAGE_NAME libfathom-dev)
set(CPACK_DEBIAN_DEVEL_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVEL_PACKAGE_DEPENDS
    "libgmp-dev, libmpfr-dev, libopenexr-dev, libpng-dev, zlib1g-dev, libdeflate-dev, libfreetype-dev, libssl-dev, libtbb-dev, libhwy-dev")
if(FATHOM_C)
  string(PREPEND CPACK_DEBIAN_DEVEL_PACKAGE_DEPENDS "${FATHOM_PACKAGE_NAME_runtime} (= ${PROJECT_VERSION}), ")
endif()
set(CPACK_DEBIAN_DEVEL_PACKAGE_RECOMMENDS "fathom (= ${PROJECT_VERSION}), cmake")
set(CPACK_DEBIAN_DEVEL_PACKAGE_SUGGESTS "libeigen3-dev, libvtk9-dev")
set(CPACK_COMPONENT_DEVEL_DESCRIPTION "reference depth-map rasterizer (development files)
Headers and static libraries for C++, the header for C, and the package for
CMake, with which a renderer's test suite has its depth maps judged.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-fathom)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
if(FATHOM_PYTHON)
  execute_process(COMMAND "${FATHOM_PYTHON_INTERPRETER}" -c "import sys; print(sys.version_info.minor)"
                  OUTPUT_VARIABLE minor OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "reference depth-map rasterizer (Python 3 module)
The module fathom renders exact depth maps of arrays, explains their pixels
and judges the maps of other renderers.")

# Every package says what it may be used for, and what changed.
foreach(component ${FATHOM_PACKAGE_COMPONENTS})
  set(documents "${CMAKE_INSTALL_DATADIR}/doc/${FATHOM_PACKAGE_NAME_${component}}")
  install(FILES "${PROJECT_SOURCE_DIR}/cmake/debian/copyright" DESTINATION "${documents}" COMPONENT ${component})
  install(CODE "
    execute_process(COMMAND gzip -9 -n -c \"${PROJECT_SOURCE_DIR}/cmake/debian/changelog\"
                    OUTPUT_FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${documents}/changelog.gz\")"
          COMPONENT ${component})
endforeach()
# The package of the program also has the pages, and the meshes and scenes that they use.
if(FATHOM_DOCUMENTS)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${FATHOM_DOCUMENTS}" COMPONENT program
          PATTERN site EXCLUDE)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/meshes" "${PROJECT_SOURCE_DIR}/data/scenes"
          "${PROJECT_SOURCE_DIR}/data/cameras" DESTINATION "${FATHOM_DOCUMENTS}/examples" COMPONENT program)
endif()
include(CPack)
