# What `pip` writes of an installed package, for a module that CMake builds or installs: the name and version by which
# importlib.metadata finds it, and the entry points by which pytest finds the fixture assert_depth. All of it stands in
# pyproject.toml, but for the version, which is the project's.
#   fathom_python_metadata(RESULT)    RESULT: the folder NAME-VERSION.dist-info
function(fathom_python_metadata result)
  set(settings "${PROJECT_SOURCE_DIR}/pyproject.toml")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${settings}")
  file(READ "${settings}" text)
  foreach(key name description requires-python)
    if(NOT text MATCHES "\n${key} = \"([^\"\n]+)\"")
      message(FATAL_ERROR "${settings}: expected ${key} = \"…\"")
    endif()
    set(${key} "${CMAKE_MATCH_1}")
  endforeach()
  if(NOT text MATCHES "\ndependencies = \\[\"([^\"\n]+)\"\\]")
    message(FATAL_ERROR "${settings}: expected one dependency")
  endif()
  set(dependency "${CMAKE_MATCH_1}")
  if(NOT text MATCHES "\n\\[project\\.entry-points\\.([a-z0-9]+)\\]\n([^\n]+)\n")
    message(FATAL_ERROR "${settings}: expected one entry point")
  endif()
  set(group "${CMAKE_MATCH_1}")
  string(REPLACE "\"" "" entry "${CMAKE_MATCH_2}")

  string(REPLACE "-" "_" folder "${name}")
  file(GLOB older "${PROJECT_BINARY_DIR}/python/*.dist-info")
  if(older)
    file(REMOVE_RECURSE ${older})
  endif()
  set(folder "${PROJECT_BINARY_DIR}/python/${folder}-${PROJECT_VERSION}.dist-info")
  file(WRITE "${folder}/METADATA"
       "Metadata-Version: 2.1\nName: ${name}\nVersion: ${PROJECT_VERSION}\nSummary: ${description}\n"
       "License: GPL-3.0-or-later\nRequires-Python: ${requires-python}\nRequires-Dist: ${dependency}\n")
  file(WRITE "${folder}/entry_points.txt" "[${group}]\n${entry}\n")
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()
