#pragma once

#include <string>

#include "validation/drawn_map.h"
#include "validation/world_mesh.h"

namespace fathom::validation {

/// The mesh drawn by VTK with a depth attachment of `variant`: "own" (the one that VTK makes),
/// "own 8 samples" (multisampled; 8 is its default), unorm16, unorm24, unorm32 or float32, the
/// latter four also as "… reversed" (glClipControl), "… reversed by shader" and
/// "… logarithmic" (by shader).
/// `camera` has finite near and far.
/// Fails    InputError where there is no OpenGL; UsageError where there is no such variant.
DrawnMap draw_vtk(const WorldMesh& mesh, const Camera& camera, const std::string& variant);

}  // namespace fathom::validation
