#pragma once

#include "fathom/camera/camera.h"

class vtkRenderer;

namespace fathom::vtk {

/// The renderer's camera, including near and far, from the binary64 matrices that VTK's mappers
/// get.
/// Fails    InputError if no Camera has such matrices, or if the camera is not of VTK's OpenGL.
Camera camera_of(vtkRenderer& renderer);

}  // namespace fathom::vtk
