#pragma once

#include <string>

#include "fathom/attribution/world_mesh.h"
#include "validation/drawn_map.h"
#include "validation/variants/opengl_variant.h"

namespace fathom::validation {

/// The mesh drawn by OpenGL into a framebuffer without a display: positions in binary32 relative to
/// the eye (orthographic: to the middle of the mesh), one matrix rounded to binary32, the depth test
/// GL_LESS (or GL_GREATER). Window depths and triangle numbers are read back.
///
/// Needs    finite near and far.
/// Fails    InputError if there is no OpenGL 4.5 or no such attachment.
DrawnMap draw_opengl(const attribution::WorldMesh& mesh, const Camera& camera,
                     const OpenGlVariant& variant);

}  // namespace fathom::validation
