#pragma once

#include <array>

#include "fathom/geometry/frames.h"
#include "fathom/numeric/ratio.h"

namespace fathom::evaluation {

/// The square of the distance of a point from the nearest point of a triangle, which may be without
/// area; scene units.
Ratio squared_distance(const WorldPoint& p, const std::array<WorldPoint, 3>& triangle);

}  // namespace fathom::evaluation
