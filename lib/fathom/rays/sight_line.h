#pragma once

#include <optional>

#include "fathom/rays/sight_end.h"
#include "fathom/rays/walk_ray.h"

namespace fathom::rays {

/// The ray that is at `from` for t = 0 and at `to` for t = 1, from t = 0 to t = 1. nullopt if the
/// bounds leave its direction open, or if `from` is not near the scene: then prepare() takes the
/// exact ray.
std::optional<WalkRay> prepare_between(const CertifiedVector& from, const CertifiedVector& to);

}  // namespace fathom::rays
