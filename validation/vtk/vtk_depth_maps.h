#pragma once

#include "fathom/attribution/world_mesh.h"
#include "validation/drawn_map.h"
#include "validation/variants/vtk_variant.h"

namespace fathom::validation {

/// The mesh drawn by VTK.
/// Needs    finite near and far.
/// Fails    InputError if there is no OpenGL, if VTK has made another matrix of the camera, or for
///          a logarithmic depth if near is not in front of the eye.
DrawnMap draw_vtk(const attribution::WorldMesh& mesh, const Camera& camera,
                  const VtkVariant& variant);

}  // namespace fathom::validation
