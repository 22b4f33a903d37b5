#pragma once

#include <vector>

#include "fathom/clipping/sweep.h"

/// What sweeps over edges share.
namespace fathom::clipping {

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
