#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fathom/clipping/numbered_points.h"

/// What lies below every edge: the one question about space that the polygon clippers ask.
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

}  // namespace fathom::clipping
