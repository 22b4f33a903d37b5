#pragma once

#include "fathom/area/image_cell.h"

namespace fathom::area {

/// Whether an edge of one of two surfaces has the other outside: they have no area in common on the
/// image. Exact; false does not tell where one of them reaches behind the camera.
///
/// Every point of s projects to Σ λᵢ·cornerᵢ with λᵢ ≥ 0. So an edge function of t that is positive
/// at no corner of s is positive nowhere in s, wherever its corners are. A corner that both have,
/// as in every mesh, lies on two edges of t, which no interval could tell.
bool are_disjoint(const SurfaceRegion& s, const SurfaceRegion& t);

}  // namespace fathom::area
