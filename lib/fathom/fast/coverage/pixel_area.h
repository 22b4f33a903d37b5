#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/coverage/square_edges.h"
#include "fathom/numeric/interval.h"

namespace fathom::fast {

/// The area of the union of convex polygons within the unit square, in binary64 with a bound
/// (square_edges.h). No predicate has to be right: contacts of any kind, common edges and slivers
/// need no special care.
class PixelUnion {
 public:
  void clear();
  /// Corners in the order of the boundary, either way round, finite; they may lie outside the
  /// square. `area_error`: a bound on the area, within the square, by which the polygon differs
  /// from the intended one.
  void add(std::span<const SquarePoint> corners, double area_error);
  /// An interval that contains the area of the union of the polygons that are meant, within [0, 1].
  Interval area();

 private:
  double covered_length(std::span<const SquareEdges::Crossing> crossings);

  SquareEdges edges_;
  /// Whether the line that is followed is inside each polygon.
  std::vector<char> is_inside_;
  std::int32_t polygons_ = 0;
  double error_ = 0;
};

/// f = c + a·x + b·y ≥ 0.
struct UncertainHalfPlane {
  /// Finite: an infinite term minus another one is NaN, which no comparison finds on either side.
  double a, b, c;
  /// A bound on the error of f at any point of the unit square, including the roundings of its
  /// evaluation; +∞ if unknown.
  double error;
};

/// The part of the unit square on the inner sides of lines.
/// Source   [SH74]
class ClippedSquare {
 public:
  ClippedSquare() : corners_{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, count_(4) {}
  void clip(const UncertainHalfPlane& half_plane);
  [[nodiscard]] std::span<const SquarePoint> corners() const {
    return std::span(corners_).first(count_);
  }
  /// At most by how much area this differs from the square clipped by the exact lines.
  [[nodiscard]] double area_error() const { return area_error_; }

 private:
  static constexpr std::size_t most = 16;
  std::array<SquarePoint, most> corners_;
  std::size_t count_;
  double area_error_ = 0;
};

/// The area within the unit square of the points that at least one triangle covers, from the edges
/// across which the number of covering triangles changes (EdgeBalance) and that number at one point
/// of the square, in binary64 with a bound.
class PixelWinding {
 public:
  void clear();
  /// Adds an edge `times` times; its triangle is turned so that its area is positive.
  /// `position_error` bounds the errors of the ends' coordinates. Edges with the same computed ends
  /// are merged.
  void add(const SquarePoint& from, const SquarePoint& to, double position_error, int times = 1);
  /// How many edges differ from each other.
  [[nodiscard]] std::size_t size() const { return added_.size(); }

  /// An interval that contains the area, within [0, 1]. `count(point)` is the number of triangles
  /// that cover a point of the square, if it is certain that it is the same for all points within
  /// the position errors around it; otherwise negative. If it is negative at several points of each
  /// slab, the area is unknown ({0, 1}).
  template <class Count>
  Interval area(const Count& count);

 private:
  using Crossings = std::span<const SquareEdges::Crossing>;
  /// Between crossings: to the left of number `place`, or to the right of all.
  struct Gap {
    std::size_t place;
    double left, width;
  };
  static Gap widest_gap(Crossings crossings);
  /// The number at the left side of the square, from that in a gap.
  static int number_at_side(Crossings crossings, const Gap& gap, int number);
  /// The length where the number is positive.
  static double covered_length(Crossings crossings, int number_at_side);
  [[nodiscard]] Interval enclose(double sum) const;
  void set_edges();

  /// Between ends in order; `times` is negative if the edge goes from `second` to `first`.
  struct Added {
    SquarePoint first, second;
    int times;
  };
  std::vector<Added> added_;
  SquareEdges edges_;
  double error_ = 0;
};

template <class Count>
Interval PixelWinding::area(const Count& count) {
  // Where there is no edge, it is all or nothing.
  if (added_.empty()) {
    const int number = count(SquarePoint{0.5, 0.5});
    return number < 0 ? Interval{0, 1} : number > 0 ? Interval{1, 1} : Interval{0, 0};
  }
  set_edges();
  int at_top = -1;
  bool known = false;
  const auto divide = [](const SquareEdges::Strip&) { return false; };
  edges_.for_each_slab(divide, [&](const SquareEdges::Slab& slab) {
    const Gap gap = widest_gap(slab.crossings);
    // All points below are farther than 2ξ from any crossing.
    if (gap.width < 8 * edges_.crossing_error()) return true;
    // Not the middle: edges of regular meshes pass through it.
    for (const double share : {0.4142, 0.6180, 0.2679}) {
      const int number = count(SquarePoint{gap.left + gap.width * share, slab.middle});
      known = number >= 0;
      at_top = number_at_side(slab.crossings, gap, number) - slab.passed;
      if (known) return false;
    }
    return true;
  });
  if (!known) return {0, 1};
  const auto all_or_nothing = [&](const SquareEdges::Strip& strip) {
    const int number = at_top + strip.passed;
    return number + strip.least > 0 ? 1.0 : number + strip.greatest <= 0 ? 0.0 : -1.0;
  };
  return enclose(edges_.integrate(all_or_nothing, [&](const SquareEdges::Slab& slab) {
    return covered_length(slab.crossings, at_top + slab.passed);
  }));
}

}  // namespace fathom::fast
