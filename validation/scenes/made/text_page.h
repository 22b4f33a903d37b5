#pragma once

#include <cstdint>

#include "fathom/mesh/mesh.h"

namespace fathom::bench {

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

}  // namespace fathom::bench
