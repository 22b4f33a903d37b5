# Installs the built library and configures the project that uses it, with the C++ example of
# docs/reference/cpp.md as one of its programs.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")

# What the program tells of itself is where man and the shells look for it.
foreach(file man/man1/fathom.1 man/man1/fathom-camera-look-at.1 man/man1/fathom-pipeline-trace.1
             bash-completion/completions/fathom zsh/vendor-completions/_fathom
             fish/vendor_completions.d/fathom.fish)
  file(GLOB found "${WORK}/prefix/share/${file}" "${WORK}/prefix/share/${file}.gz")
  if(NOT found)
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()

file(READ "${SOURCE}/docs/reference/cpp.md" page)
string(REGEX MATCH "```cpp\n([^`]*)```" found "${page}")
if(NOT found)
  message(FATAL_ERROR "docs/reference/cpp.md has no C++ example")
endif()
file(WRITE "${WORK}/cpp_example.cpp" "${CMAKE_MATCH_1}")
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${WORK}/build"
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DEXAMPLE=${WORK}/cpp_example.cpp"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}")
