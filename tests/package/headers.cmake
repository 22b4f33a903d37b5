# Each installed header compiles when nothing is included before it.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
build(headers)
