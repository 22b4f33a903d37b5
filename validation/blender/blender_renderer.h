#pragma once

#include "fathom/attribution/model/renderer_input.h"
#include "validation/drawn_map.h"

namespace fathom::validation {

/// The mesh rendered by Blender's Cycles on the processor: one sample per pixel, the Depth pass of
/// a multilayer EXR. A mesh far from the origin is moved there, because Blender holds positions in
/// binary32.
/// Fails    InputError if there is no Blender, if it fails, or if it cannot express the camera.
DrawnMap draw_blender(const attribution::WorldMesh& mesh, const Camera& camera);

}  // namespace fathom::validation
