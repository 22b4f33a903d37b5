#pragma once

#include <cstdint>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/world_mesh.h"

namespace fathom::attribution {

/// A number for each point of a mesh, the same for points at the same place: the least index among
/// them. So triangles that share an edge are recognised whatever indices a file gives them.
/// Exact    positions are compared bit by bit, but −0 is 0.
std::vector<std::uint32_t> corner_numbers(const WorldMesh& mesh);

/// The same of a mesh that a renderer holds in parts: points of two parts never are the same, since
/// two matrices take them to the image. Positions are those in the part's frame.
std::vector<std::uint32_t> corner_numbers(const std::vector<RasterPart>& parts);

}  // namespace fathom::attribution
