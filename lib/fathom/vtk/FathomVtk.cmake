# fathom::vtk, compiled with the VTK of whoever includes this: of this source tree, and of the installed package, which has
# the sources.
# In a function, so that the project keeps its own VTK_LIBRARIES.
function(fathom_find_vtk)
  find_package(VTK 9.1 QUIET COMPONENTS CommonCore CommonDataModel CommonMath RenderingCore RenderingOpenGL2)
endfunction()
fathom_find_vtk()
if(NOT TARGET VTK::RenderingOpenGL2)
  return()
endif()
set(files explain_depth depth_buffer drawn_scene)
list(TRANSFORM files PREPEND "${CMAKE_CURRENT_LIST_DIR}/")
list(TRANSFORM files APPEND ".cpp")
add_library(fathom_vtk STATIC EXCLUDE_FROM_ALL ${files})
add_library(fathom::vtk ALIAS fathom_vtk)
target_compile_features(fathom_vtk PUBLIC cxx_std_20)
target_include_directories(fathom_vtk PRIVATE "${CMAKE_CURRENT_LIST_DIR}/../..")
# Bounds are computed as they were proved: a * b + c is rounded twice.
target_compile_options(fathom_vtk PRIVATE -ffp-contract=off)
target_link_libraries(fathom_vtk PUBLIC fathom::attribution
                      PRIVATE VTK::CommonCore VTK::CommonDataModel VTK::CommonMath VTK::RenderingCore VTK::RenderingOpenGL2
                              $<TARGET_NAME_IF_EXISTS:VTK::glew> $<TARGET_NAME_IF_EXISTS:VTK::glad>
                              $<TARGET_NAME_IF_EXISTS:VTK::opengl>)
