#pragma once

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include "fathom/camera/camera.h"

namespace fathom::validation {

/// A translucent pane across the whole view, a thousandth of the way from near to far: in front of
/// all but what nearly touches the near plane.
vtkSmartPointer<vtkActor> translucent_pane(const Camera& camera);

}  // namespace fathom::validation
