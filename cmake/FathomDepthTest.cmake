# Tests of a renderer's depth maps, for ctest: docs/validation.md, "In your own test suite".
#
#   fathom_add_depth_test(NAME name SCENE file… CAMERA file [MODEL model] COMMAND program argument…
#                         [MAP_FORMAT exr|pfm|png|npy|bin] [CHANNEL channel] [PNG_SCALE codes-per-unit]
#                         [BASELINE report.json] [TIMEOUT seconds] [LABELS label…] [WORKING_DIRECTORY folder])
#
# The test runs COMMAND, which draws SCENE as CAMERA sees it into {map}, and has the map judged by
# fathom-validate. In arguments of COMMAND
#   {map}     is the file to write; MAP_FORMAT is its suffix (default exr),
#   {camera}  is CAMERA,
#   {scene}   is SCENE: an argument that is nothing else becomes one for each file,
# and program may be a target. Paths are relative to the source folder of the calling CMakeLists.txt. TIMEOUT
# (default 300) is how long COMMAND may take, and the judging again. MODEL is what is assumed of the renderer
# (default auto: the model that fits best).
# What is wrong with the arguments is an error at configure time.

# Where the package lies, for calls from any folder.
set_property(GLOBAL PROPERTY FATHOM_DEPTH_TEST_RUNNER "${CMAKE_CURRENT_LIST_DIR}/run-depth-test")

# A file argument as an absolute path. What may be made later, below the build tree or by a generator
# expression, need not be there yet.
function(_fathom_find_file result keyword file)
  set(path "${file}")
  if(NOT path MATCHES "\\$<")
    get_filename_component(path "${path}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
    string(FIND "${path}/" "${CMAKE_BINARY_DIR}/" below)
    if(NOT EXISTS "${path}" AND NOT below EQUAL 0)
      message(FATAL_ERROR "fathom_add_depth_test: ${keyword}: there is no file ${path}")
    endif()
  endif()
  set(${result} "${path}" PARENT_SCOPE)
endfunction()

# The models that the program knows, asked once; none where it cannot run here.
function(_fathom_models result program)
  get_property(is_known GLOBAL PROPERTY FATHOM_MODELS SET)
  if(NOT is_known)
    execute_process(COMMAND "${program}" --help OUTPUT_VARIABLE help ERROR_QUIET)
    set(models "")
    string(REGEX REPLACE "[ \n]+" " " help "${help}") # which is broken into lines
    if(help MATCHES "Models: ([a-z0-9, -]+)")
      string(REPLACE ", " ";" models "${CMAKE_MATCH_1}")
    endif()
    set_property(GLOBAL PROPERTY FATHOM_MODELS "${models}")
  endif()
  get_property(models GLOBAL PROPERTY FATHOM_MODELS)
  set(${result} "${models}" PARENT_SCOPE)
endfunction()

# A folder of its own below the build tree, whatever characters the name has.
function(_fathom_folder_of result name)
  string(REGEX REPLACE "[^A-Za-z0-9_.+-]" "-" folder "${name}")
  if(NOT folder STREQUAL name OR folder MATCHES "^\\.+$")
    string(SHA256 hash "${name}")
    string(SUBSTRING "${hash}" 0 8 hash)
    string(APPEND folder "-${hash}")
  endif()
  set(${result} "${CMAKE_CURRENT_BINARY_DIR}/depth-tests/${folder}" PARENT_SCOPE)
endfunction()

function(fathom_add_depth_test)
  set(needed NAME SCENE CAMERA COMMAND)
  set(one NAME CAMERA MODEL MAP_FORMAT CHANNEL PNG_SCALE BASELINE TIMEOUT WORKING_DIRECTORY)
  cmake_parse_arguments(PARSE_ARGV 0 TEST "" "${one}" "SCENE;COMMAND;LABELS")
  foreach(keyword IN LISTS needed)
    if("${TEST_${keyword}}" STREQUAL "")
      message(FATAL_ERROR "fathom_add_depth_test: ${keyword} is missing")
    endif()
  endforeach()
  if(DEFINED TEST_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "fathom_add_depth_test: '${TEST_UNPARSED_ARGUMENTS}' belongs to none of its keywords")
  endif()
  if(DEFINED TEST_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "fathom_add_depth_test: ${TEST_KEYWORDS_MISSING_VALUES} has no value")
  endif()
  if(TEST "${TEST_NAME}")
    message(FATAL_ERROR "fathom_add_depth_test: NAME: there is a test '${TEST_NAME}' already")
  endif()

  get_property(program GLOBAL PROPERTY FATHOM_VALIDATE)
  if(NOT EXISTS "${program}")
    message(FATAL_ERROR "fathom_add_depth_test: there is no ${program}: build all of Fathom and install it again")
  endif()
  if(NOT DEFINED TEST_MODEL)
    set(TEST_MODEL auto)
  endif()
  _fathom_models(models "${program}")
  if(models AND NOT TEST_MODEL IN_LIST models AND NOT TEST_MODEL STREQUAL "auto")
    list(JOIN models ", " names)
    message(FATAL_ERROR "fathom_add_depth_test: MODEL: there is no model '${TEST_MODEL}'; there are ${names}")
  endif()
  if(NOT DEFINED TEST_MAP_FORMAT)
    set(TEST_MAP_FORMAT exr)
  elseif(NOT TEST_MAP_FORMAT MATCHES "^(exr|pfm|png|npy|bin)$")
    message(FATAL_ERROR "fathom_add_depth_test: MAP_FORMAT: '${TEST_MAP_FORMAT}' is not exr, pfm, png, npy or bin")
  endif()
  if(NOT DEFINED TEST_TIMEOUT)
    set(TEST_TIMEOUT 300)
  elseif(NOT TEST_TIMEOUT MATCHES "^[1-9][0-9]*$")
    message(FATAL_ERROR "fathom_add_depth_test: TIMEOUT: '${TEST_TIMEOUT}' is not a number of seconds")
  endif()
  if(NOT "${TEST_COMMAND}" MATCHES "{map}")
    message(FATAL_ERROR "fathom_add_depth_test: COMMAND has no {map}: the file that it writes")
  endif()

  _fathom_folder_of(folder "${TEST_NAME}")
  set(map "${folder}/map.${TEST_MAP_FORMAT}")
  _fathom_find_file(camera CAMERA "${TEST_CAMERA}")
  set(scenes "")
  foreach(file IN LISTS TEST_SCENE)
    _fathom_find_file(scene SCENE "${file}")
    list(APPEND scenes "${scene}")
  endforeach()
  set(judging --camera "${camera}" --model "${TEST_MODEL}")
  if(DEFINED TEST_CHANNEL)
    list(APPEND judging --channel "${TEST_CHANNEL}")
  endif()
  if(DEFINED TEST_PNG_SCALE)
    list(APPEND judging --png-scale "${TEST_PNG_SCALE}")
  endif()
  if(DEFINED TEST_BASELINE)
    _fathom_find_file(baseline BASELINE "${TEST_BASELINE}")
    list(APPEND judging --baseline "${baseline}")
  endif()

  # As code, so that empty arguments and those with semicolons stay what they are.
  set(command "")
  list(LENGTH scenes scene_count)
  foreach(argument IN LISTS TEST_COMMAND)
    if(argument STREQUAL "{scene}")
      foreach(scene IN LISTS scenes)
        string(APPEND command " [==[${scene}]==]")
      endforeach()
      continue()
    elseif(argument MATCHES "{scene}" AND scene_count GREATER 1)
      message(FATAL_ERROR "fathom_add_depth_test: COMMAND: '${argument}' has place for one file, and SCENE has ${scene_count}")
    endif()
    # add_test() takes a target for its file only where it is the very program of the test.
    if(command STREQUAL "" AND argument MATCHES "^[A-Za-z0-9_.:+-]+$")
      set(is_target "$<TARGET_EXISTS:${argument}>")
      set(argument "$<${is_target}:$<TARGET_FILE:${argument}>>$<$<NOT:${is_target}>:${argument}>")
    endif()
    string(REPLACE "{map}" "${map}" argument "${argument}")
    string(REPLACE "{camera}" "${camera}" argument "${argument}")
    string(REPLACE "{scene}" "${scenes}" argument "${argument}")
    string(APPEND command " [==[${argument}]==]")
  endforeach()

  get_property(runner GLOBAL PROPERTY FATHOM_DEPTH_TEST_RUNNER)
  cmake_language(EVAL CODE "
    add_test(NAME \"\${TEST_NAME}\"
             COMMAND \"\${runner}\" \"\${program}\" \"\${map}\" \"\${folder}\" \${TEST_TIMEOUT} \${judging} \${scenes} --
                     ${command})")
  # The runner has the last word on what takes too long: it says what it was.
  math(EXPR patience "2 * ${TEST_TIMEOUT} + 60")
  set_tests_properties("${TEST_NAME}" PROPERTIES TIMEOUT ${patience} LABELS "${TEST_LABELS}")
  if(DEFINED TEST_WORKING_DIRECTORY)
    get_filename_component(place "${TEST_WORKING_DIRECTORY}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
    set_tests_properties("${TEST_NAME}" PROPERTIES WORKING_DIRECTORY "${place}")
  endif()
endfunction()
