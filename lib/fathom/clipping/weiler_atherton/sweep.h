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

}  // namespace fathom::clipping
