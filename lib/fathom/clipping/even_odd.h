#pragma once

#include "fathom/clipping/points.h"

/// The even-odd rule beside an edge: the one question that the clippers of polygons ask of space.
namespace fathom::clipping {

/// Whether the points just left and just right of the middle of an edge are inside.
struct Beside {
  bool left, right;

  friend bool operator==(const Beside&, const Beside&) = default;
};

/// `a` → `b` against `rings`, read by the even-odd rule: a ray from the middle M of ab counts the
/// edges that it crosses, half-open at their ends; an edge through M itself tells left from right.
/// So one answer says inside (both), outside (neither), or along a border (one of them).
/// Exact    over Rational, if an edge through M covers all of ab (contacts.h).
template <class Number>
Beside inside_beside(const Point2<Number>& a, const Point2<Number>& b, const Rings<Number>& rings);

}  // namespace fathom::clipping
