#pragma once

#include "validation/studies/hidden_surface/sight.h"

namespace fathom::studies {

/// Hidden surfaces by a tree of planes: the first polygon's plane divides the others, which are cut
/// where they pass through it, into those before and those behind, and so on; painted in the order
/// behind, on the plane, before, as seen from the eye. The tree does not depend on the eye.
/// Source   [FKN80]
Sight bsp_tree(const Scene& scene, const Camera& camera);

}  // namespace fathom::studies
