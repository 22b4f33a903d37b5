# One program uses every room, and each room's use links with that room's target alone.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
build(rooms)
file(STRINGS "${WORK}/build/rooms.txt" rooms)
foreach(room ${rooms})
  run("${WORK}/build/alone_${room}")
endforeach()
run("${WORK}/build/together")
