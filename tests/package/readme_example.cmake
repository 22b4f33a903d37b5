# Takes the C++ example out of README.md, builds it as another project would, and runs it.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${out}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(READ "${SOURCE}/README.md" readme)
string(REGEX MATCH "```cpp\n([^`]*)```" found "${readme}")
if(NOT found)
  message(FATAL_ERROR "README.md has no C++ example")
endif()
file(WRITE "${WORK}/example/main.cpp" "${CMAKE_MATCH_1}")
file(WRITE "${WORK}/example/CMakeLists.txt" [[
cmake_minimum_required(VERSION 3.22)
project(Example LANGUAGES CXX)
find_package(Fathom REQUIRED)
add_executable(example main.cpp)
target_link_libraries(example PRIVATE fathom::fathom)
]])

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
run("${CMAKE_COMMAND}" -S "${WORK}/example" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/example" "${SOURCE}/data/meshes/spot.obj" "${WORK}/example.exr")

# The example's map is the program's.
run("${WORK}/prefix/bin/fathom" render "${SOURCE}/data/meshes/spot.obj" -o "${WORK}/program.exr")
run("${WORK}/prefix/bin/fathom" compare "${WORK}/program.exr" "${WORK}/example.exr")
