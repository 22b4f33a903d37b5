#pragma once

#include "validation/colour/lit_triangles.h"

namespace fathom::validation {

/// VTK's names for its ways of shading (vtkProperty::SetInterpolation).
enum class VtkShading { flat, gouraud, phong };

/// The scene drawn and lit by VTK: one directional light of the scene, white; its own framebuffer
/// of 8 bits, black behind; no culling; positions in binary32 as they are given.
/// Fails    InputError if there is no OpenGL, or if the shader that VTK made does not light as
///          expected_colour.h says that it does.
GreyPicture draw_vtk_colours(const LitScene& scene, VtkShading shading);

}  // namespace fathom::validation
