#pragma once

#include <cstdint>

#include "fathom/mesh/mesh.h"

namespace fathom::bench {

/// A tree of about 20 metres on the origin, y up, in metres: branches of six sides, each of which
/// forks into four, `forks` times, and about each of the 4^forks twigs `leaves` leaves of two
/// triangles each, 20 millimetres long and 14 wide, folded along the middle.
Mesh tree(std::uint32_t forks, std::uint32_t leaves);

}  // namespace fathom::bench
