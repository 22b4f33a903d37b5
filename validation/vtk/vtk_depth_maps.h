#pragma once

#include "validation/drawn_map.h"
#include "validation/variants/vtk_variant.h"
#include "validation/world_mesh.h"

namespace fathom::validation {

/// The mesh drawn by VTK. `camera` has finite near and far.
/// Fails    InputError where there is no OpenGL.
DrawnMap draw_vtk(const WorldMesh& mesh, const Camera& camera, const VtkVariant& variant);

}  // namespace fathom::validation
