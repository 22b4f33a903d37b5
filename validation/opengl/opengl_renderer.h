#pragma once

#include "fathom/attribution/world_mesh.h"
#include "validation/drawn_map.h"
#include "validation/variants/opengl_variant.h"

namespace fathom::validation {

/// The mesh drawn by OpenGL into a framebuffer without a display: positions in binary32 relative to
/// the eye (orthographic: to the middle of the mesh), one matrix rounded to binary32, the depth
/// test GL_LESS (or GL_GREATER). Window depths and triangle numbers are read back.
///
/// Needs    finite near and far; as an EglContext with a driver does.
/// Fails    InputError if there is no such driver, no OpenGL 3.3 (glClipControl for reversed
///          depths), no such attachment or not so many samples.
DrawnMap draw_opengl(const attribution::WorldMesh& mesh, const Camera& camera,
                     const OpenGlVariant& variant);

}  // namespace fathom::validation
