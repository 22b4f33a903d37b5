#pragma once

#include "fathom/attribution/judgement.h"

namespace fathom::attribution {

/// The finding that the map does not show the scene, which replaces findings about missing
/// triangles: the map is empty, the scene has nothing in view, or at least nine tenths of the
/// pixels that show a surface in either are unexplained and no fault of the whole image explains
/// them, as in a map of another scene or camera. No finding if nine tenths of them show about the
/// right depth.
void name_other_scene(Judgement& judgement);

}  // namespace fathom::attribution
