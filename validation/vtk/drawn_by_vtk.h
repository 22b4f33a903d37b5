#pragma once

#include <array>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "validation/colour/lit_triangles.h"
#include "validation/drawn_map.h"
#include "validation/variants/variants.h"

/// What VTK draws: depth maps, and lit scenes in colour.
namespace fathom::validation {

/// The mesh drawn by VTK.
/// Needs    finite near and far.
/// Fails    InputError if there is no OpenGL, if VTK has made another matrix of the camera, or for
///          a logarithmic depth if near is not in front of the eye.
DrawnMap draw_vtk(const attribution::WorldMesh& mesh, const Camera& camera,
                  const VtkVariant& variant);

/// VTK's names for its ways of shading (vtkProperty::SetInterpolation).
enum class VtkShading { flat, gouraud, phong };

/// The scene drawn and lit by VTK: one directional light of the scene, white; its own framebuffer
/// of 8 bits, black behind; no culling; positions in binary32 as they are given.
/// Fails    InputError if there is no OpenGL, or if VTK's shader does not compute light as
///          expected_colour.h assumes.
GreyPicture draw_vtk_colours(const LitScene& scene, VtkShading shading);

/// Whether a matrix from held positions to clip coordinates, row by row, is the camera's: each
/// entry is computed from the camera and the model's shift and scale in binary64 and rounded once
/// to binary32. A model takes the renderer's matrix as given. Without this check it would explain a
/// picture of another camera.
///
/// Needs    near and far of the camera as the model's mapping does.
bool is_matrix_of(const Camera& camera, const attribution::RasterModel& model,
                  const std::array<float, 16>& clip_from_held);

}  // namespace fathom::validation
