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
  /// square. `area_error`: at most by how much area, within the square, the polygon differs from
  /// the one that is meant.
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
  /// Of f at any point of the unit square, including the roundings of its evaluation; +∞: nothing
  /// is known.
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

}  // namespace fathom::fast
