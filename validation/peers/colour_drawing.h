#pragma once

#include <functional>

#include "validation/vtk/vtk_colours.h"

namespace fathom::validation {

/// Makes the scene and has VTK draw it in colour in a process of its own, which is ended after
/// `seconds`.
/// Needs    a process that has started no threads.
/// Fails    as `make` does; InputError, in one line, where VTK or OpenGL is not there;
///          ChildFailure.
GreyPicture draw_colours_in_child(const std::function<LitScene()>& make, VtkShading shading,
                                  int seconds);

}  // namespace fathom::validation
