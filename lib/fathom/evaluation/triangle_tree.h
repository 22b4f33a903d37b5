#pragma once

#include <cstdint>
#include <vector>

#include "fathom/evaluation/placed_triangles.h"

namespace fathom::evaluation {

/// A box along the axes.
struct Box {
  Vector lower, upper;
};

/// The smallest box around three corners.
Box box_of(const PlacedTriangles::Corners& corners);

/// A tree of boxes around the triangles of a surface, which must outlive it: each box contains the
/// corners of its triangles as PlacedTriangles has them.
class TriangleTree {
 public:
  explicit TriangleTree(const PlacedTriangles& triangles);

  struct Node {
    Box box;
    /// A leaf has `count` triangles from `first` on of order(); a node without any has the children
    /// that are next in nodes(), and at `first`.
    std::uint32_t first = 0, count = 0;
  };
  /// The root comes first; empty for a surface without triangles.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Numbers of triangles.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  void build(const PlacedTriangles& triangles, std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace fathom::evaluation
