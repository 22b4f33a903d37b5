#pragma once

#include <string>

#include "fathom/attribution/world_mesh.h"
#include "validation/drawn_map.h"
#include "validation/variants/opengl_variant.h"

namespace fathom::validation {

/// The mesh drawn by OpenGL into a framebuffer without a display: positions in binary32 about the
/// eye (orthographic: the middle of the mesh), one matrix rounded to binary32, the depth test
/// GL_LESS (or GL_GREATER). Reads back window depths and the numbers of the triangles. `camera` has
/// finite near and far. Fails    InputError where there is no OpenGL 4.5, or no such attachment.
DrawnMap draw_opengl(const attribution::WorldMesh& mesh, const Camera& camera,
                     const OpenGlVariant& variant);

/// Whether a driver, told by its version, interpolates depth between corners as they were before
/// they were snapped: Mesa's llvmpipe does. OpenGL leaves it open; of others the wider bound is
/// assumed.
bool interpolates_before_snapping(const std::string& version);

}  // namespace fathom::validation
