#pragma once

#include <vector>

#include "fathom/rays/split_elements.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::rays {

/// Elements of a crowd without repeated triangles, which are added to `repeated`. Sorts the
/// elements; the first of equal ones, which remains, has the lowest number.
/// Exact    corners are compared in binary64, and then as exact numbers.
Elements without_repetitions(Elements crowd, const PlacedTriangles& triangles,
                             const TriangleSource& source, std::vector<Repetition>& repeated);

}  // namespace fathom::rays
