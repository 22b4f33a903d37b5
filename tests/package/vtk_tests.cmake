# The project of docs/validation.md, a regression test of VTK outside the tree; and another one with a fault in VTK.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
file(READ "${SOURCE}/docs/validation.md" page)

# write_block(LANGUAGE BEGINNING FILE): the page's block of code that begins so.
function(write_block language beginning file)
  string(REGEX MATCH "```${language}\n(${beginning}[^`]*)```" found "${page}")
  if(NOT found)
    message(FATAL_ERROR "docs/validation.md has no ${file} for VTK")
  endif()
  file(WRITE "${WORK}/vtk_example/${file}" "${CMAKE_MATCH_1}")
endfunction()
write_block(cmake "cmake_minimum_required" CMakeLists.txt)
write_block(cpp "#include <fathom" my_test.cpp)

# build_project(SOURCE FOLDER)
function(build_project source folder)
  file(REMOVE_RECURSE "${WORK}/${folder}")
  run("${CMAKE_COMMAND}" -S "${source}" -B "${WORK}/${folder}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
      "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
  run("${CMAKE_COMMAND}" --build "${WORK}/${folder}" --parallel ${PROCESSORS})
endfunction()
build_project("${WORK}/vtk_example" vtk_example_build)
build_project("${CMAKE_CURRENT_LIST_DIR}/vtk_tests" vtk_tests)

# expect(PROGRAM STATUS BEGINNING): VTK's windows need a display.
function(expect program status beginning)
  execute_process(COMMAND xvfb-run -a "${WORK}/${program}" RESULT_VARIABLE is OUTPUT_VARIABLE out ERROR_VARIABLE err)
  string(FIND "${out}" "${beginning}" at)
  if(NOT is EQUAL status OR NOT at EQUAL 0)
    message(FATAL_ERROR "${program} was expected to end with ${status} and begin with\n  ${beginning}\n"
                        "but it ended with ${is}:\n${out}${err}")
  endif()
endfunction()
expect(vtk_example_build/my_test 0 "every pixel is explained\n")
expect(vtk_tests/faulty 1 "aspect: the horizontal focal length is off by +0.1000")
