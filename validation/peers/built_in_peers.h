#pragma once

#include "validation/peers/drawing.h"

namespace fathom::validation {

/// vtk, opengl and embree, which this program may be built without.
/// Fails    InputError where it is, or where the renderer does not start.
DrawnMap draw_built_in(const Peer& peer, const ValidationScene& scene);

}  // namespace fathom::validation
