#pragma once

#include <vector>

#include "fathom/fast/coverage/square_edges.h"
#include "fathom/numeric/interval.h"

namespace fathom::fast {

/// The area within the unit square of the points that at least one triangle covers, from the edges
/// across which the number of covering triangles changes (EdgeBalance) and that number at a point
/// of each slab (square_edges.h), in binary64 with a bound.
class PixelWinding {
 public:
  void clear();
  /// An edge of a triangle turned so that its area is positive, which is there so many times.
  /// `position_error` bounds the errors of the ends' coordinates. Edges with the same computed ends
  /// become one.
  void add(const SquarePoint& from, const SquarePoint& to, double position_error, int times = 1);
  /// How many edges differ from each other.
  [[nodiscard]] std::size_t size() const { return added_.size(); }

  /// An interval that contains the area, within [0, 1]. `count(point)` is the number of triangles
  /// that cover a point of the square, if it is certain that it is the same for all points within
  /// the position errors around it; otherwise negative. If it is negative at several points,
  /// nothing is known about the area ({0, 1}).
  template <class Count>
  Interval area(const Count& count);

 private:
  struct Crossing {
    double x;
    int change;  // of the number, from left to right
  };
  /// Crossings of a horizontal line in order, between the square's sides.
  void find_crossings(double height);
  /// Between crossings: to the left of number `place`, or to the right of all.
  struct Gap {
    std::size_t place;
    double left, width;
  };
  [[nodiscard]] Gap widest_gap() const;
  /// Length of the gaps where the number is positive; it is `number` in gap `known`.
  [[nodiscard]] double covered_length(std::size_t known, int number) const;
  [[nodiscard]] Interval enclose(double sum) const;
  void set_edges();

  /// Between ends in order; `times` is negative if the edge goes from `second` to `first`.
  struct Added {
    SquarePoint first, second;
    int times;
  };
  std::vector<Added> added_;
  SquareEdges edges_;
  std::vector<Crossing> crossings_;
  double error_ = 0;
};

template <class Count>
Interval PixelWinding::area(const Count& count) {
  set_edges();
  edges_.cut(false);
  bool known = true;
  const double sum = edges_.integrate([&](double height) {
    if (!known) return 0.0;
    find_crossings(height);
    const Gap gap = widest_gap();
    // Not the middle: edges of regular meshes pass through it.
    for (const double share : {0.4142, 0.6180, 0.2679}) {
      const int number = count(SquarePoint{gap.left + gap.width * share, height});
      if (number >= 0) return covered_length(gap.place, number);
    }
    known = false;
    return 0.0;
  });
  return known ? enclose(sum) : Interval{0, 1};
}

}  // namespace fathom::fast
