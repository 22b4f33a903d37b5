#pragma once

#include <cstdint>

#include "fathom/mesh/mesh.h"

namespace fathom::bench {

/// What a scanner makes of a boulder about the origin, of radius 0.7 to 1.3: a surface with bumps
/// of all sizes, shaken by the scanner's noise; triangles that are up to ten times as large in one
/// place as in another; patches and single triangles that it did not see. About 97 % of `triangles`
/// are left; vertices of those that are gone remain.
Mesh scan(std::uint64_t triangles);

}  // namespace fathom::bench
