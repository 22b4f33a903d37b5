cmake_minimum_required(VERSION 3.22)
# run(COMMAND…): fails with the command's output where it fails. build(TARGET…): of the consumer.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${out}")
  endif()
endfunction()

function(build)
  run("${CMAKE_COMMAND}" --build "${WORK}/build" --parallel ${PROCESSORS} --target ${ARGN})
endfunction()
