#pragma once

#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "validation/drawn_map.h"
#include "validation/variants/variants.h"

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

/// The numbers of samples per pixel, above one and in increasing order, that a driver offers for 24
/// bits of depth together with numbers of triangles.
/// Needs    as an EglContext with a driver does.
/// Fails    InputError if there is no OpenGL or no such driver.
std::vector<int> offered_samples(Driver driver);

}  // namespace fathom::validation
