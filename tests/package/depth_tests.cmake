# Tests of a renderer by fathom_add_depth_test: what passes, what fails and the line that says why, and what
# CDash gets.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(build "${WORK}/depth_tests")
file(REMOVE_RECURSE "${build}")
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/depth_tests" -B "${build}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DFATHOM=${WORK}/prefix/bin/fathom")
run("${CMAKE_COMMAND}" --build "${build}")

# expect(TEST passes|fails BEGINNING): the first line of its output begins with this. A # in it is any number.
function(expect test verdict beginning)
  string(REGEX REPLACE "[][+.*()^]" "\\\\\\0" name "${test}")
  execute_process(COMMAND "${CMAKE_CTEST_COMMAND}" --test-dir "${build}" -R "^${name}$" -V
                  RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if((verdict STREQUAL "passes") EQUAL (NOT status EQUAL 0))
    message(FATAL_ERROR "${test} was expected to be one that ${verdict}:\n${out}")
  endif()
  string(REGEX MATCH "\n[0-9]+: Test timeout[^\n]*\n[0-9]+: ([^\n]*)" found "${out}")
  set(line "${CMAKE_MATCH_1}")
  string(REGEX REPLACE "[][+.*()^$?|]" "\\\\\\0" pattern "${beginning}")
  string(REPLACE "#" "[0-9]+" pattern "${pattern}")
  if(NOT line MATCHES "^${pattern}")
    message(FATAL_ERROR "${test}: the first line is\n  ${line}\nand was expected to begin with\n  ${beginning}\n${out}")
  endif()
endfunction()
expect(right passes "scene, map float32-ray: ")
expect(shift fails "shift: the image is shifted by (-0.5, -0.5")
expect(noise fails "# of 3072 pixels unexplained, the worst (#, #): #.# instead of #.#, allowed ")
expect(crash fails "the renderer crashed: SIGSEGV")
expect(fail fails "the renderer ended with exit status 3")
# A map that lies there from an earlier run is not judged.
configure_file("${build}/depth-tests/right/map.pfm" "${build}/depth-tests/nothing/map.pfm" COPYONLY)
expect(nothing fails "the renderer wrote no map: expected it at ${build}/depth-tests/nothing/map.pfm")
expect(half fails "no verdict on the map: ${build}/depth-tests/half/map.pfm: ")
expect(hang fails "the renderer did not end within 2 seconds (TIMEOUT)")
expect(absent fails "the renderer cannot be started: there is no program no-such-renderer")
expect("name with/odd & characters" passes "scene, map float32-ray: ")
expect(scenes passes "scene, map gl-unorm24: ")
expect(baseline fails "no verdict on the map: ${build}/baseline.json: ")
configure_file("${build}/depth-tests/right/report/report.json" "${build}/baseline.json" COPYONLY)
expect(baseline passes "scene, map float32-ray: ")
configure_file("${build}/depth-tests/scenes/report/report.json" "${build}/baseline.json" COPYONLY)
expect(baseline fails "${build}/baseline.json: has none of the results of this run")

# What CDash gets, of a map that is right and of one that is not.
execute_process(COMMAND "${CMAKE_CTEST_COMMAND}" --test-dir "${build}" -T Test -L depth -R "right|noise" OUTPUT_QUIET
                ERROR_QUIET)
file(GLOB results "${build}/Testing/*/Test.xml")
run(/usr/bin/python3 "${CMAKE_CURRENT_LIST_DIR}/check_test_xml.py" "${results}")

# refuses(LINE argument…): fathom_add_depth_test with these arguments stops the configuration with this line.
function(refuses line)
  set(source "${WORK}/depth_test_arguments")
  set(given "")
  foreach(argument IN LISTS ARGN)
    string(APPEND given " [==[${argument}]==]")
  endforeach()
  file(WRITE "${source}/CMakeLists.txt" "
    cmake_minimum_required(VERSION 3.22)
    project(Arguments LANGUAGES NONE)
    enable_testing()
    find_package(Fathom REQUIRED COMPONENTS depth_test)
    add_test(NAME taken COMMAND true)
    fathom_add_depth_test(${given})\n")
  execute_process(COMMAND "${CMAKE_COMMAND}" -S "${source}" -B "${source}/build" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
                  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE err)
  # CMake breaks messages into lines.
  string(REGEX REPLACE "[ \n]+" " " err "${err}")
  string(FIND "${err}" "fathom_add_depth_test: ${line}" at)
  if(status EQUAL 0 OR at EQUAL -1)
    message(FATAL_ERROR "${ARGN}\nwas expected to be refused with\n  ${line}\nbut the status is ${status}:\n${err}")
  endif()
endfunction()
set(scene "${CMAKE_CURRENT_LIST_DIR}/depth_tests/scene.obj")
set(camera "${CMAKE_CURRENT_LIST_DIR}/depth_tests/camera.json")
set(most SCENE "${scene}" CAMERA "${camera}" MODEL float32-ray)
refuses("NAME is missing" ${most} COMMAND draw {map})
refuses("SCENE is missing" NAME a CAMERA "${camera}" MODEL float32-ray COMMAND draw {map})
refuses("COMMAND is missing" NAME a ${most})
refuses("COMMAND has no {map}: the file that it writes" NAME a ${most} COMMAND draw map.exr)
refuses("MODEL: there is no model 'voxel'; there are gl-unorm16, " NAME a SCENE "${scene}" CAMERA "${camera}" MODEL voxel
        COMMAND draw {map})
refuses("CAMERA: there is no file ${WORK}/depth_test_arguments/none.json" NAME a SCENE "${scene}" CAMERA none.json
        MODEL float32-ray COMMAND draw {map})
refuses("MAP_FORMAT: 'tiff' is not exr, pfm, png or npy" NAME a ${most} COMMAND draw {map} MAP_FORMAT tiff)
refuses("TIMEOUT: '0' is not a number of seconds" NAME a ${most} COMMAND draw {map} TIMEOUT 0)
refuses("CHANNEL has no value" NAME a ${most} COMMAND draw {map} CHANNEL)
refuses("'more' belongs to none of its keywords" more NAME a ${most} COMMAND draw {map})
refuses("NAME: there is a test 'taken' already" NAME taken ${most} COMMAND draw {map})
refuses("COMMAND: '--mesh={scene}' has place for one file, and SCENE has 2" NAME a SCENE "${scene}" "${scene}"
        CAMERA "${camera}" MODEL float32-ray COMMAND draw --mesh={scene} {map})
