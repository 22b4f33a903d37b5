#pragma once

#include <optional>
#include <vector>

#include "fathom/clipping/points.h"

/// Predicates of polygons in window coordinates, where y grows down. Every sign refers to the
/// picture on the screen: counter-clockwise turns and windings are positive, and "left" means left
/// as seen, when walking along the edge. (As numbers, such a ring has a negative cross product at
/// its convex corners.)
/// Exact    over Exact; in floating point every sign is the sign of a rounded number.
namespace fathom::pipeline {

template <class Number>
using Ring = clipping::Ring<Number>;
template <class Number>
using Rings = clipping::Rings<Number>;
template <class Number>
using Point = clipping::Point2<Number>;

/// f(x, y) = (y₁ − y₂)x + (x₂ − x₁)y + x₁y₂ − x₂y₁, the implicit form of the line a → b with y up;
/// with y down its sign is reversed. Positive on the left as seen.
template <class Number>
Number left_of(const Point<Number>& a, const Point<Number>& b, const Point<Number>& p);

/// Whether the point is left of every edge or right of every edge, or on an edge: the inside of a
/// convex ring. For other rings this is a part of the inside, or empty.
template <class Number>
bool is_on_one_side_of_every_edge(const Ring<Number>& ring, const Point<Number>& p);

/// How a horizontal ray from the point to the right meets the outline. Edges are half-open as in
/// area_fill.h (y_min ≤ y < y_max), and a crossing counts if it is to the right of the point, so
/// that the answers agree with the pixels that are filled.
struct RayCrossings {
  int count = 0;  ///< odd: inside by the even-odd rule
  /// How often the outline goes round the point, counter-clockwise as seen; not 0: inside by the
  /// non-zero rule.
  int winding = 0;
  bool on_outline = false;
};
template <class Number>
RayCrossings ray_crossings(const Rings<Number>& rings, const Point<Number>& p);

struct Convexity {
  /// Whether the ring turns only one way, straight corners allowed, and around once.
  bool convex = false;
  /// Whether all corners are on one side of all edges: either no corner is left of any edge, or no
  /// corner is right of any edge. Gives the same answer, but needs n² tests.
  bool corners_on_one_side = false;
  /// For each corner: +1 turns left as seen, −1 right, 0 straight on or back.
  std::vector<int> turns;
  /// How often the ring's direction turns around, counter-clockwise as seen; nullopt if an edge has
  /// no length or turns straight back, because the number is meaningless then.
  std::optional<int> turning_number;
};
template <class Number>
Convexity convexity_of(const Ring<Number>& ring);

/// The convex hull, counter-clockwise as seen from its leftmost, then uppermost corner; corners on
/// its edges are left out. One or two points if all points are equal or on one line.
/// Source   [And79]
template <class Number>
Ring<Number> convex_hull(std::vector<Point<Number>> points);

/// Whether the point lies in a hull as convex_hull gives it, or on its border.
template <class Number>
bool is_in_hull(const Ring<Number>& hull, const Point<Number>& p);

/// Σ wᵢPᵢ / Σ wᵢ: barycentric coordinates over any number of points. If no weight is negative, the
/// result lies in the convex hull of the points.
/// Shape    a weight for each point; their sum is not 0.
template <class Number>
Point<Number> combination(const std::vector<Point<Number>>& points,
                          const std::vector<Number>& weights);

}  // namespace fathom::pipeline
