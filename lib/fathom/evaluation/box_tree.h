#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/rays/placed_triangles.h"

/// Bounds on what binary64 loses where every coordinate is below 1 (power_of_unit). Each is proved
/// by a script of its name in validation/proofs; what underflows is less than 2⁻¹⁰⁰⁰ and lost in
/// them.
namespace fathom::evaluation::bounds {

/// How far a coordinate of a corner may be from the exact one: it is rounded once.
inline constexpr double corner_error = rays::placing_error;

/// The same of a point of a triangle, A + u·(B − A) + v·(C − A) with u and v in [0, 1]
/// (evaluation_point).
inline constexpr double point_error = 0x1p-49;

/// The same of the difference of such a point and a corner (evaluation_difference).
inline constexpr double difference_error = 0x1p-48;

/// The error of the distance of a point from a box (evaluation_gap), and of both bounds on its
/// distance from a triangle (evaluation_place, evaluation_plane).
inline constexpr double distance_error = 0x1p-44;

}  // namespace fathom::evaluation::bounds

namespace fathom::evaluation {
using rays::in_unit;
using rays::PlacedTriangles;
using rays::power_of_unit;
using rays::Vector;

/// A box along the axes.
struct Box {
  Vector lower, upper;
};

/// The smallest box around points.
Box box_of(std::span<const Vector> points);

class PlacedCloud;

/// A tree of boxes around triangles or points, which must outlive it: each box contains the corners
/// as PlacedTriangles or PlacedCloud has them. Does not depend on the number of threads.
class BoxTree {
 public:
  explicit BoxTree(const PlacedTriangles& triangles);
  /// Of exactly equal points, a leaf may contain only one.
  explicit BoxTree(const PlacedCloud& points);

  struct Node {
    Box box;
    /// A leaf has `count` elements from `first` on of order(); a node without any has the children
    /// that are next in nodes(), and at `first`.
    std::uint32_t first = 0, count = 0;
  };
  /// The root comes first; empty for a tree around nothing.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Numbers of triangles or points.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  template <class Elements>
  void build(const Elements& elements, std::uint32_t begin, std::uint32_t end, std::uint32_t node);
  template <class Elements>
  void build(const Elements& elements);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace fathom::evaluation
