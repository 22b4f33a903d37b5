#pragma once

#include <cstdint>

#include "fathom/mesh/mesh.h"

namespace fathom::bench {

/// Metres between the middles of two streets. Streets lie along x and z at all multiples of it.
inline constexpr double street_spacing = 60;

/// A city of blocks × blocks houses about the origin, on the plane y = 0, y up, in metres. Walls
/// have a ledge around each floor and a pier between windows, as long as the wall and a few
/// decimetres wide; pavements, lines and wires run along the streets, some through all of the city.
Mesh city(std::uint32_t blocks);

}  // namespace fathom::bench
