#pragma once

#include <string>

class vtkProp;

namespace fathom::vtk {

/// Why a prop's depths cannot be compared, as a clause without its subject; empty if it is an actor
/// with only opaque triangles.
/// Needs    its mapper's input to be up to date.
std::string reason_to_leave_out(vtkProp& prop);

}  // namespace fathom::vtk
