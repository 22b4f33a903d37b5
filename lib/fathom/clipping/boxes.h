#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"

/// Boxes in binary64 around points that may be exact: a filter that settles most decisions.
namespace fathom::clipping {

/// least ≤ x ≤ greatest for the number x that it stands for.
struct Bounds {
  double least, greatest;

  [[nodiscard]] bool is_below(const Bounds& other) const { return greatest < other.least; }
  /// The number is known.
  [[nodiscard]] bool is_exact() const { return least == greatest; }
  /// Numbers that are equal have equal bounds.
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

inline Bounds bounds_of(double x) {
  return {x, x};
}
Bounds bounds_of(const Rational& x);

/// A box around points; closed.
struct Box {
  Bounds x, y;

  void include(const Box& other) {
    x = {std::min(x.least, other.x.least), std::max(x.greatest, other.x.greatest)};
    y = {std::min(y.least, other.y.least), std::max(y.greatest, other.y.greatest)};
  }
  [[nodiscard]] bool is_exact() const { return x.is_exact() && y.is_exact(); }
  [[nodiscard]] bool meets(const Box& other) const {
    return !x.is_below(other.x) && !other.x.is_below(x) && !y.is_below(other.y) &&
           !other.y.is_below(y);
  }
};

template <class Number>
Box box_of(const Point2<Number>& p) {
  return {bounds_of(p.x), bounds_of(p.y)};
}

template <class Number>
Box box_of(const Point2<Number>& a, const Point2<Number>& b) {
  Box box = box_of(a);
  box.include(box_of(b));
  return box;
}

template <class Number>
Box box_of(const Ring<Number>& ring) {
  Box box = box_of(ring[0]);
  for (const Point2<Number>& p : ring) box.include(box_of(p));
  return box;
}

/// The sign of cross(a, b, c) for points in these boxes, where the boxes settle it.
std::optional<int> settled_sign_of_cross(const Box& a, const Box& b, const Box& c);

/// Calls visit(i, k) once for every box i of one list and box k of the other that meet, in no
/// order.
/// Cost     n log n and the pairs
/// Source   [ZE02]: a segment tree of the boxes that is streamed, by CGAL.
void visit_meeting_boxes(const std::vector<Box>& some, const std::vector<Box>& others,
                         const std::function<void(std::size_t, std::size_t)>& visit);

}  // namespace fathom::clipping
