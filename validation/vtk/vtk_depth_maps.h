#pragma once

#include "fathom/attribution/world_mesh.h"
#include "validation/drawn_map.h"
#include "validation/variants/vtk_variant.h"

namespace fathom::validation {

/// The mesh drawn by VTK. `camera` has finite near and far.
/// Fails    InputError where there is no OpenGL.
DrawnMap draw_vtk(const attribution::WorldMesh& mesh, const Camera& camera,
                  const VtkVariant& variant);

}  // namespace fathom::validation
