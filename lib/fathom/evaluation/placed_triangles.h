#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/scene/triangle_source.h"

namespace fathom::evaluation {

using Vector = std::array<double, 3>;

/// Powers of two to measure in: every corner of the scene has coordinates of less than 2 to this
/// power, exactly.
long power_of_unit(const TriangleSource& triangles);

/// The triangles of a scene in the world, in binary64 and in a unit in which all coordinates are
/// below 1: bounds on errors are plain numbers then, and nothing overflows.
class PlacedTriangles {
 public:
  /// Each coordinate is within bounds::corner_error of the exact one: of corners that are placed as
  /// they are nothing is lost but what lies below 2⁻¹⁰⁷⁴, and others are rounded once.
  using Corners = std::array<Vector, 3>;

  /// The unit is 2 to the power of `power`, at least power_of_unit().
  PlacedTriangles(const TriangleSource& triangles, long power);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(corners_.size()); }
  [[nodiscard]] const Corners& operator[](std::uint32_t number) const { return corners_[number]; }
  [[nodiscard]] long power() const { return power_; }

 private:
  long power_;
  std::vector<Corners> corners_;
};

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
