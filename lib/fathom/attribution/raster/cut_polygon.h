#pragma once

#include <array>
#include <vector>

#include "fathom/attribution/raster/clip_vertex.h"

namespace fathom::attribution {

/// The part of a polygon inside the near plane and, where `at_border`, inside the image and the far
/// plane: Sutherland and Hodgman's algorithm [SH74] on homogeneous coordinates.
std::vector<ClipVertex> cut(const std::array<const ClipVertex*, 3>& triangle, bool at_border);

/// Whether all corners lie beyond one border of the view volume, whatever their errors are.
bool is_certainly_outside(const std::array<const ClipVertex*, 3>& triangle);

/// Whether all of the triangle lies inside the view volume whatever its errors are, so that nothing
/// is cut.
bool is_certainly_inside(const std::array<const ClipVertex*, 3>& triangle);

}  // namespace fathom::attribution
