#pragma once

#include <array>
#include <cstdint>

#include "fathom/mesh/mesh.h"

/// Parts of meshes.
namespace fathom::bench {

using Vector3 = std::array<double, 3>;

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 operator*(double k, const Vector3& a) {
  return {k * a[0], k * a[1], k * a[2]};
}
Vector3 cross(const Vector3& a, const Vector3& b);
Vector3 unit(const Vector3& a);

/// Two unit vectors at right angles to each other and to `axis`; axis, u, v is right-handed.
struct Across {
  Vector3 u, v;
};
Across across(const Vector3& axis);

/// The number of the new vertex.
std::uint32_t add_vertex(Mesh& mesh, const Vector3& p);

/// Two triangles: corner, corner + a, corner + a + b, corner + b; facing a × b.
void add_parallelogram(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b);

/// A box with the edges a, b, c from `corner`, twelve triangles that face outwards if a × b·c > 0.
void add_box(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b,
             const Vector3& c);

/// The side of a prism or frustum from one circle to another: `sides` quads of its whole length,
/// facing outwards.
void add_tube(Mesh& mesh, const Vector3& from, double from_radius, const Vector3& to,
              double to_radius, std::uint32_t sides);

/// A convex polygon of the last `corners` vertices of the mesh, as a fan from the first of them.
void add_fan(Mesh& mesh, std::uint32_t corners);

// Large meshes of the kinds that cities, scanners, trees, fonts and CAD programs make.

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

/// A scan of a boulder around the origin, of radius 0.7 to 1.3: a surface with bumps of all sizes
/// and the noise of a scanner; triangles that are up to ten times as large in one place as in
/// another; missing patches and single triangles. About 97 % of `triangles` are left; vertices of
/// missing triangles remain.
Mesh scan(std::uint64_t triangles);

/// A page of text in the plane z = 0, x to the right, y up, with its top left corner at the origin,
/// one em a unit: `lines` lines, 1.3 apart, of 100 letters or spaces of 0.7 each. Letters are made
/// of stems and bows, outlines triangulated without further points, as programs that draw text do
/// it: fans from one corner to all points of two round ends, strips between two arcs; most
/// triangles are slivers.
Mesh text_page(std::uint32_t lines);

/// The width of a page, and the height of a page with this many lines.
inline constexpr double page_width = 70;
inline double page_height(std::uint32_t lines) {
  return 1.3 * lines;
}

/// A tree of about 20 metres on the origin, y up, in metres: branches of six sides, each of which
/// forks into four, `forks` times, and about each of the 4^forks twigs `leaves` leaves of two
/// triangles each, 20 millimetres long and 14 wide, folded along the middle.
Mesh tree(std::uint32_t forks, std::uint32_t leaves);

}  // namespace fathom::bench
