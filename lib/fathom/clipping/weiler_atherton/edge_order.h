#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// What lies below every edge: the one question about space that the polygon clippers ask.
/// What sweeps over edges share.
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

/// An edge, by its place in the list, and the next one below it just right of its left end. Upright
/// edges count as rising steeply: what is right of them is below.
struct SweptEdge {
  std::size_t edge;
  std::optional<std::size_t> below;
};

/// The edges in the order in which a line that moves from left to right comes upon them, from below
/// at each point; so the one below always stands before. Edges meet at most in ends, none comes
/// twice. (By rounded numbers they may cross. Then the answer is some order of the edges.)
/// Cost     n log n
/// Source   [SH76], without its search for crossings
std::vector<SweptEdge> sweep(const std::vector<UndirectedEdge>& edges, const PointOrder& points);

/// The order from below of edges that a line from left to right meets at the same time, by their
/// places in a list. Of edges along each other the earlier one in the list counts as below. Edges
/// may touch, and must not have crossed before where the line is.
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
    // The one that begins later tells on which side of the other it is, or else how it goes on.
    int turn = p.left <= q.left ? points->turn(p.left, p.right, q.left)
                                : -points->turn(q.left, q.right, p.left);
    if (turn == 0) turn = points->turn(p.left, p.right, q.right);
    return turn != 0 ? turn > 0 : a < b;
  }
};

/// Where closed lists pass through one point more than once: which way each goes on.

struct DirectedEdge {
  std::size_t from, to;
};

std::vector<DirectedEdge> edges_of(const NumberedRings& rings);

/// Closed lists that together run along every edge once. The edges bound a region, which lies to
/// their left; whoever comes to a point leaves it by the first edge clockwise from where it came:
/// the other border of the same wedge of the region. So parts of the region that only touch are
/// bounded apart, and what touches a border from within is joined to it. Where no point is passed
/// twice, there is nothing to choose.
///
/// Lists begin with the first edges, in the given order.
/// Fails    InputError if edges that come and go do not alternate about a point; over Rational that
///          cannot happen.
NumberedRings joined_by_wedges(const std::vector<DirectedEdge>& edges, const PointOrder& points);

/// Closed lists, taken apart where one passes through a point again, so that each ring is simple.
NumberedRings simple_rings(const NumberedRings& closed_lists, const PointOrder& points);

/// Rounding has made nonsense of how the rings lie.
[[noreturn]] void refuse_what_rounding_broke();

}  // namespace fathom::clipping
