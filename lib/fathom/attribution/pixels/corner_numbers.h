#pragma once

#include <cstdint>
#include <vector>

#include "fathom/attribution/world_mesh.h"

namespace fathom::attribution {

/// A number for each point of a mesh, the same for points at the same place: the least index among
/// them. So triangles that share an edge are recognised whatever indices a file gives them.
/// Exact    positions are compared bit by bit, but −0 is 0.
std::vector<std::uint32_t> corner_numbers(const WorldMesh& mesh);

}  // namespace fathom::attribution
