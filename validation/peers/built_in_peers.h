#pragma once

#include <vector>

#include "validation/drawn_map.h"
#include "validation/scenes/validation_scenes.h"
#include "validation/variants/peer.h"
#include "validation/vtk/drawn_by_vtk.h"

namespace fathom::validation {

/// VTK, OpenGL and Embree, which this program may be built without.
/// Fails    InputError where it is, or where the renderer does not start.
DrawnMap draw_built_in(const VtkVariant& variant, const ValidationScene& scene);
DrawnMap draw_built_in(const OpenGlVariant& variant, const ValidationScene& scene);
DrawnMap draw_built_in(const EmbreeVariant& variant, const ValidationScene& scene);

/// A lit scene drawn by VTK in colour. Fails as above.
GreyPicture draw_built_in_colours(const LitScene& scene, VtkShading shading);

/// The numbers of samples per pixel, more than one, that this driver of OpenGL offers; none where
/// this program is built without OpenGL.
/// Fails    InputError where OpenGL does not start.
std::vector<int> built_in_samples(Driver driver);

}  // namespace fathom::validation
