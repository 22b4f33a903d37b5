#pragma once

#include <vector>

#include "fathom/clipping/boxes.h"
#include "fathom/clipping/points.h"

/// The even-odd rule beside an edge: the one question about space that the polygon clippers ask.
namespace fathom::clipping {

/// Whether the points just left and just right of the middle of an edge are inside.
struct Beside {
  bool left, right;

  friend bool operator==(const Beside&, const Beside&) = default;
};

/// Rings read by the even-odd rule, to be asked more than once. The rings must outlive this.
template <class Number>
class EvenOdd {
 public:
  explicit EvenOdd(const Rings<Number>& rings);

  /// What lies beside a → b: a ray from the middle M of ab counts the edges that it crosses,
  /// half-open at their ends; the edges that are ab itself tell left from right. So one answer says
  /// inside (both), outside (neither), or along a border (one of them).
  ///
  /// Cost     the edges of one band: few, unless edges reach far across the ray
  /// Exact    over Rational, if no other edge passes through M: contacts are entered (contacts.h).
  [[nodiscard]] Beside beside(const Point2<Number>& a, const Point2<Number>& b) const;

 private:
  struct Edge {
    const Point2<Number>*p, *q;
    Box at_p, at_q;
  };
  /// Bands across one axis, each with the numbers of the edges that reach into it.
  struct Bands {
    /// Where one band ends and the next begins.
    std::vector<Number> limits;
    std::vector<std::vector<std::size_t>> edges;
    [[nodiscard]] std::size_t band_of(const Number& coordinate) const;
  };
  [[nodiscard]] Bands bands_of(Number Point2<Number>::*axis) const;

  std::vector<Edge> edges_;
  /// Across y, for rays towards +x, and across x, for rays towards +y.
  Bands across_y_, across_x_;
};

}  // namespace fathom::clipping
