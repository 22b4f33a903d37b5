#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// The order of edges: the edge below each edge, which is the only spatial question of the polygon
/// clippers, and the order of edges about a point, which decides how closed lists continue where
/// they pass through a point more than once.
namespace fathom::clipping {

/// An edge without its direction; left < right.
struct UndirectedEdge {
  std::size_t left, right;

  friend bool operator==(const UndirectedEdge&, const UndirectedEdge&) = default;
  friend bool operator<(const UndirectedEdge& a, const UndirectedEdge& b) {
    return a.left != b.left ? a.left < b.left : a.right < b.right;
  }
};

inline UndirectedEdge undirected(std::size_t from, std::size_t to) {
  return from < to ? UndirectedEdge{from, to} : UndirectedEdge{to, from};
}

/// An edge, by its place in the list, and the next edge below it just right of its left end.
/// Upright edges count as rising steeply: points to the right of them are below.
struct SweptEdge {
  std::size_t edge;
  std::optional<std::size_t> below;
};

/// The edges in the order in which a line that moves from left to right reaches them, from below at
/// each point; so the edge below always comes first. Edges meet at most in ends, and no edge occurs
/// twice. (Rounded edges may cross. Then the result is some order of the edges.)
/// Cost     n log n
/// Source   [SH76], without its search for crossings
std::vector<SweptEdge> sweep(const std::vector<UndirectedEdge>& edges, const PointOrder& points);

/// The order from below of edges that a line from left to right meets at the same time, by their
/// places in a list. If edges run along each other, the edge that comes first in the list counts as
/// below. Edges may touch, but must not cross to the left of the line.
struct IsBelow {
  struct Point {
    std::size_t number;
  };
  using is_transparent = void;
  const std::vector<UndirectedEdge>* edges;
  const PointOrder* points;

  bool operator()(std::size_t edge, Point p) const {
    const auto& [left, right] = (*edges)[edge];
    return points->turn(left, right, p.number) > 0;
  }
  bool operator()(std::size_t a, std::size_t b) const {
    if (a == b) return false;
    const UndirectedEdge &p = (*edges)[a], &q = (*edges)[b];
    // The left end of the edge that begins later decides the order or, if it lies on the other
    // edge, q's right end does.
    int turn = p.left <= q.left ? points->turn(p.left, p.right, q.left)
                                : -points->turn(q.left, q.right, p.left);
    if (turn == 0) turn = points->turn(p.left, p.right, q.right);
    return turn != 0 ? turn > 0 : a < b;
  }
};

struct DirectedEdge {
  std::size_t from, to;
};

std::vector<DirectedEdge> edges_of(const NumberedRings& rings);

/// Closed lists that together run along every edge once. The edges bound a region, which lies to
/// their left; a list that reaches a point leaves it by the first edge clockwise from the edge of
/// its arrival: the other border of the same wedge of the region. So parts of the region that only
/// touch have separate boundaries, and a ring that touches a border from within is joined to it. If
/// no point is passed twice, there is no choice.
///
/// Lists begin with the first edges, in the given order.
/// Fails    InputError if arriving and leaving edges do not alternate about a point; over Rational
///          that cannot happen.
NumberedRings joined_by_wedges(const std::vector<DirectedEdge>& edges, const PointOrder& points);

/// Divides closed lists where they pass through a point again, so that each ring is simple.
NumberedRings simple_rings(const NumberedRings& closed_lists, const PointOrder& points);

/// Throws because rounding has broken the nesting of the rings.
[[noreturn]] void refuse_what_rounding_broke();

}  // namespace fathom::clipping
