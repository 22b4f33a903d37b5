#pragma once

#include <optional>
#include <string>

#include "fathom/camera/camera.h"

class vtkRenderer;

namespace fathom::vtk {

/// What the camera of VTK's matrices has that does not follow from the position, focal point, view
/// up, view angle or parallel scale, window centre, model transform and clipping range of its
/// vtkCamera, by more than sums in binary64 may lose: a clause. Nothing where all of it does, or
/// where the vtkCamera has a user's view transform, an explicit projection, shear or an off-axis
/// projection, which are matrices themselves.
/// Source   vtkCamera's documentation: what each of them means.
std::optional<std::string> fault_of_matrices(vtkRenderer& renderer, const Camera& of_matrices);

}  // namespace fathom::vtk
