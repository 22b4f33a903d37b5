# Where Eigen is not found the package has all but fathom::eigen_conversions, and says so to who asks for it.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
file(WRITE "${WORK}/without_eigen/CMakeLists.txt" "
cmake_minimum_required(VERSION 3.22)
project(WithoutEigen LANGUAGES CXX)
find_package(Fathom REQUIRED)
if(NOT TARGET fathom::fathom OR TARGET fathom::eigen_conversions)
  message(FATAL_ERROR \"expected fathom::fathom without fathom::eigen_conversions\")
endif()
find_package(Fathom QUIET COMPONENTS eigen_conversions)
if(Fathom_FOUND)
  message(FATAL_ERROR \"eigen_conversions is said to be there\")
endif()
")
run("${CMAKE_COMMAND}" -S "${WORK}/without_eigen" -B "${WORK}/without_eigen/build"
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON)
