#pragma once

#include <compare>
#include <span>
#include <vector>

#include "fathom/area/plane/edge_rule.h"
#include "fathom/area/plane/line_sweep.h"
#include "fathom/area/plane/resolve.h"

/// Edges that lie exactly on sides between parts of the image: on each side of them another part
/// knows which triangle is visible.
namespace fathom::area {

/// The line of a side of parts: u = at if it is upright, else v = at.
struct PartSide {
  bool is_upright = false;
  double at = 0;
  // NOLINTNEXTLINE(modernize-use-nullptr): it has no pointer
  friend auto operator<=>(const PartSide&, const PartSide&) = default;
};
/// Of the side of that number in LineSweep::sides().
PartSide side_of(const PlanePart& part, std::size_t side);

/// The place where two lines of a sweep of a part cross.
ImagePlace place_of(const LineSweep& sweep, const PlanePart& part, std::uint32_t a,
                    std::uint32_t b);

/// The edges on some sides, from all parts that have triangles. Edges between triangles that are
/// `whole` are left out.
std::vector<VisibleEdge> edges_on_sides(const PlaneMesh& mesh, const EdgeRule& rule,
                                        const std::vector<PartSide>& sides,
                                        std::span<const CrowdedPart> crowded,
                                        const ResolvedParts& resolved);

}  // namespace fathom::area
