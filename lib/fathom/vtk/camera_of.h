#pragma once

#include "fathom/camera/camera.h"

class vtkRenderer;

namespace fathom::vtk {

/// The renderer's camera, from the matrices in binary64 that VTK's mappers get of it, near and far
/// those of the matrices, too.
/// Fails    InputError if no Camera has such matrices, or it is none of VTK's OpenGL.
Camera camera_of(vtkRenderer& renderer);

}  // namespace fathom::vtk
