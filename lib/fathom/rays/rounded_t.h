#pragma once

#include "fathom/rays/candidates.h"
#include "fathom/rays/cast.h"

namespace fathom::rays {

/// t of a hit that was found for a ray, rounded once: in double-words where their bounds settle it,
/// else by exact numbers.
double rounded_t(const RayScene& scene, const Ray& ray, Candidates& found,
                 const Candidates::Hit& hit);

}  // namespace fathom::rays
