# The example of docs/reference/cpp.md renders the map that the program does.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
build(cpp_example)
run("${WORK}/build/cpp_example" "${SOURCE}/data/meshes/spot.obj" "${WORK}/example.exr")
run("${WORK}/prefix/bin/fathom" render "${SOURCE}/data/meshes/spot.obj" -o "${WORK}/program.exr")
run("${WORK}/prefix/bin/fathom" compare "${WORK}/program.exr" "${WORK}/example.exr")
