#pragma once

#include <cstdint>

#include "fathom/mesh/mesh.h"

/// Large meshes of the kinds that cities, scanners, trees, fonts and CAD programs make.
namespace fathom::bench {

/// Metres between the middles of two streets. Streets lie along x and z at all multiples of it.
inline constexpr double street_spacing = 60;

/// A city of blocks × blocks houses about the origin, on the plane y = 0, y up, in metres. Walls
/// have a ledge around each floor and a pier between windows, as long as the wall and a few
/// decimetres wide; pavements, lines and wires run along the streets, some through all of the city.
Mesh city(std::uint32_t blocks);

/// A part as CAD programs tessellate it, z up: a plate of 1.5·rows × rows cells of side 1 with a
/// hole through each, the faces around it as fans from the cell's corners, the holes' walls as
/// quads as long as the plate is thick; rods through it along x, whose sides are triangles as long
/// as they and whose ends are fans from a point of the rim; rings on it of 60·rows steps each, with
/// fillets of narrow strips. The middle of the plate is the origin.
Mesh machine_part(std::uint32_t rows);

/// What a scanner makes of a boulder about the origin, of radius 0.7 to 1.3: a surface with bumps
/// of all sizes, shaken by the scanner's noise; triangles that are up to ten times as large in one
/// place as in another; patches and single triangles that it did not see. About 97 % of `triangles`
/// are left; vertices of those that are gone remain.
Mesh scan(std::uint64_t triangles);

/// A page of text in the plane z = 0, x to the right, y up, with its top left corner at the origin,
/// one em a unit: `lines` lines, 1.3 apart, of 100 letters or spaces of 0.7 each. Letters are made
/// of stems and bows, outlines triangulated without further points, as programs that draw text do
/// it: fans from one corner to all points of two round ends, strips between two arcs; most
/// triangles are slivers.
Mesh text_page(std::uint32_t lines);

/// The width of a page, and the height of one of so many lines.
inline constexpr double page_width = 70;
inline double page_height(std::uint32_t lines) {
  return 1.3 * lines;
}

/// A tree of about 20 metres on the origin, y up, in metres: branches of six sides, each of which
/// forks into four, `forks` times, and about each of the 4^forks twigs `leaves` leaves of two
/// triangles each, 20 millimetres long and 14 wide, folded along the middle.
Mesh tree(std::uint32_t forks, std::uint32_t leaves);

}  // namespace fathom::bench
