#pragma once

#include <vector>

#include "validation/peers/drawing.h"

namespace fathom::validation {

/// vtk, opengl and embree, which this program may be built without.
/// Fails    InputError where it is, or where the renderer does not start.
DrawnMap draw_built_in(const Peer& peer, const ValidationScene& scene);

/// The numbers of samples a pixel, more than one, that OpenGL's driver offers; none where this
/// program is built without.
/// Fails    InputError where OpenGL does not start.
std::vector<int> built_in_samples();

}  // namespace fathom::validation
