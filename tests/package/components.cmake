# A component that there is not is refused by its name, with those that there are.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(source "${WORK}/components")
file(REMOVE_RECURSE "${source}")
file(WRITE "${source}/CMakeLists.txt"
     "cmake_minimum_required(VERSION 3.22)\nproject(Components LANGUAGES NONE)\n"
     "find_package(Fathom REQUIRED COMPONENTS depth_tests)\n")
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${source}" -B "${source}/build" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
                RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
string(REGEX REPLACE "[ \n]+" " " line "${out}")
set(expected "there is no component 'depth_tests'; the components are depth_test, eigen_conversions and vtk")
string(FIND "${line}" "${expected}" found)
if(status EQUAL 0 OR found EQUAL -1)
  message(FATAL_ERROR "expected '${expected}', found ${status}:\n${out}")
endif()
