#pragma once

#include "fathom/rays/ray_tree.h"
#include "fathom/rays/tested_triangle.h"
#include "fathom/rays/walk_ray.h"

namespace fathom::rays {

/// Offers every triangle that the ray may meet in its stretch, nearer boxes first, until the answer
/// is known.
void walk(const RayTree& tree, const WalkRay& ray, TriangleVisitor& visitor);

}  // namespace fathom::rays
