# The ten lines of docs/validation.md as a regression test of VTK, in a project outside the tree; and with a fault in VTK.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(build "${WORK}/vtk_tests")
file(REMOVE_RECURSE "${build}")
file(READ "${SOURCE}/docs/validation.md" page)
string(REGEX MATCH "```cpp\n(#include <fathom/vtk[^`]*)```" found "${page}")
if(NOT found)
  message(FATAL_ERROR "docs/validation.md has no test of VTK")
endif()
file(WRITE "${WORK}/vtk_example.cpp" "${CMAKE_MATCH_1}")
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/vtk_tests" -B "${build}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "-DEXAMPLE=${WORK}/vtk_example.cpp" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
run("${CMAKE_COMMAND}" --build "${build}" --parallel ${PROCESSORS})

# expect(PROGRAM STATUS BEGINNING): VTK's windows need a display.
function(expect program status beginning)
  execute_process(COMMAND xvfb-run -a "${build}/${program}" RESULT_VARIABLE is OUTPUT_VARIABLE out ERROR_VARIABLE err)
  string(FIND "${out}" "${beginning}" at)
  if(NOT is EQUAL status OR NOT at EQUAL 0)
    message(FATAL_ERROR "${program} was expected to end with ${status} and begin with\n  ${beginning}\n"
                        "but it ended with ${is}:\n${out}${err}")
  endif()
endfunction()
expect(right 0 "every pixel is explained\n")
expect(faulty 1 "aspect: the horizontal focal length is off by +0.1000")
