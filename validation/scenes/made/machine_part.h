#pragma once

#include <cstdint>

#include "fathom/mesh/mesh.h"

namespace fathom::bench {

/// A part as CAD programs tessellate it, z up: a plate of 1.5·rows × rows cells of side 1 with a
/// hole through each, the faces around it as fans from the cell's corners, the holes' walls as
/// quads as long as the plate is thick; rods through it along x, whose sides are triangles as long
/// as they and whose ends are fans from a point of the rim; rings on it of 60·rows steps each, with
/// fillets of narrow strips. The middle of the plate is the origin.
Mesh machine_part(std::uint32_t rows);

}  // namespace fathom::bench
