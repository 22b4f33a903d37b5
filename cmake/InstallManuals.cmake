# Run by `cmake --install`: manual pages and completion, which the installed program makes from the texts of its own
# help and that of its companions. Expects PROGRAM, MAN_FOLDER and DATA_FOLDER, below the prefix.
if(NOT EXISTS "${PROGRAM}")
  return() # only other parts have been built
endif()
set(prefix "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
message(STATUS "Installing: manual pages and completion")

function(make_file file)
  execute_process(COMMAND "${PROGRAM}" ${ARGN} OUTPUT_FILE "${file}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(pages "${prefix}/${MAN_FOLDER}/man1")
file(GLOB older "${pages}/fathom.1*" "${pages}/fathom-*.1*")
if(older)
  file(REMOVE ${older})
endif()
execute_process(COMMAND "${PROGRAM}" help --man --out "${pages}" COMMAND_ERROR_IS_FATAL ANY)
# They have several commands, each with a page of its own.
foreach(program surfaces textbook)
  file(WRITE "${pages}/fathom-${program}.1" ".so man1/fathom.1\n")
endforeach()
find_program(GZIP_PROGRAM gzip)
if(GZIP_PROGRAM)
  file(GLOB made "${pages}/fathom.1" "${pages}/fathom-*.1")
  execute_process(COMMAND "${GZIP_PROGRAM}" -9 -n ${made} COMMAND_ERROR_IS_FATAL ANY)
endif()

file(MAKE_DIRECTORY "${prefix}/${DATA_FOLDER}/bash-completion/completions"
                    "${prefix}/${DATA_FOLDER}/zsh/vendor-completions"
                    "${prefix}/${DATA_FOLDER}/fish/vendor_completions.d")
make_file("${prefix}/${DATA_FOLDER}/bash-completion/completions/fathom" completion bash)
make_file("${prefix}/${DATA_FOLDER}/zsh/vendor-completions/_fathom" completion zsh)
make_file("${prefix}/${DATA_FOLDER}/fish/vendor_completions.d/fathom.fish" completion fish)
