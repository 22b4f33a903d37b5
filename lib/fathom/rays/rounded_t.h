#pragma once

#include "fathom/rays/candidates.h"
#include "fathom/rays/ray_tree.h"

namespace fathom::rays {

/// t of a hit of a ray, rounded once: in double-words where their bounds settle it, else by exact
/// numbers.
double rounded_t(const TriangleSource& source, const RayTree& tree, const Ray& ray,
                 const Candidates::Hit& hit);

}  // namespace fathom::rays
