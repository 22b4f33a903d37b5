# The installed package: find_package(Fathom) gives fathom::fathom and a target per room,
# fathom::eigen_conversions where Eigen is found, which find_package(Fathom COMPONENTS eigen_conversions) demands,
# fathom::vtk where COMPONENTS vtk asks for it, and fathom_add_depth_test; COMPONENTS depth_test gives that function alone.
include(CMakePackageConfigHelpers)
set(FATHOM_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/Fathom")

install(EXPORT FathomTargets NAMESPACE fathom:: DESTINATION "${FATHOM_PACKAGE_DIR}")
install(EXPORT FathomEigenTargets NAMESPACE fathom:: DESTINATION "${FATHOM_PACKAGE_DIR}")
# Not at the root of the build: find_package would find it there, without the targets, if PATH has the build's bin/.
set(generated "${PROJECT_BINARY_DIR}/generated")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/FathomConfig.cmake.in"
                              "${generated}/FathomConfig.cmake"
                              INSTALL_DESTINATION "${FATHOM_PACKAGE_DIR}"
                              PATH_VARS CMAKE_INSTALL_BINDIR)
# Before 1.0 a minor version may break the interface.
write_basic_package_version_file("${generated}/FathomConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${generated}/FathomConfig.cmake"
              "${generated}/FathomConfigVersion.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FathomDepthTest.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindDeflate.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindGMP.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindMPFR.cmake"
        DESTINATION "${FATHOM_PACKAGE_DIR}")
install(PROGRAMS "${PROJECT_SOURCE_DIR}/cmake/run-depth-test" DESTINATION "${FATHOM_PACKAGE_DIR}")
