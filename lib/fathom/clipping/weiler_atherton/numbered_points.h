#pragma once

#include <cstddef>
#include <vector>

#include "fathom/clipping/boxes.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"

/// Points that are compared once and then represented by numbers.
namespace fathom::clipping {

/// Predicates of points by their numbers, which are in lexicographic order: p < q means that p
/// comes before q. A direction is written P → q.
/// Exact    over both kernels: all predicates are signs, computed for the given points.
class PointOrder {
 public:
  PointOrder() = default;
  /// Points in lexicographic order, without repetitions.
  explicit PointOrder(const std::vector<Point2<double>>& points);
  explicit PointOrder(const std::vector<Point2<Rational>>& points);

  [[nodiscard]] std::size_t size() const { return boxes_.size(); }
  /// The sign of cross(a, b, c): 1 if c lies left of a → b.
  [[nodiscard]] int turn(std::size_t a, std::size_t b, std::size_t c) const;
  /// Whether P → a comes before P → b, counter-clockwise from straight down, which comes last.
  [[nodiscard]] bool comes_before(std::size_t P, std::size_t a, std::size_t b) const;
  /// Whether P → b lies strictly between P → a and P → c, counter-clockwise.
  [[nodiscard]] bool is_between(std::size_t P, std::size_t a, std::size_t b, std::size_t c) const;

 private:
  std::vector<Box> boxes_;
  /// Over Rational; boxes suffice for binary64 numbers.
  std::vector<Point2<Rational>> exact_;
};

/// Closed lists of points, by their numbers.
using NumberedRing = std::vector<std::size_t>;
using NumberedRings = std::vector<NumberedRing>;

template <class Number>
struct NumberedCorners {
  /// In lexicographic order, without repetitions.
  std::vector<Point2<Number>> points;
  NumberedRings rings;
};

/// The rings with each corner replaced by its number. n log n
template <class Number>
NumberedCorners<Number> numbered(const Rings<Number>& rings);

/// The ring of points of a ring of numbers.
template <class Number>
Ring<Number> ring_of(const NumberedRing& ring, const std::vector<Point2<Number>>& points) {
  Ring<Number> result;
  result.reserve(ring.size());
  for (const std::size_t corner : ring) result.push_back(points[corner]);
  return result;
}

/// The number after `corner` in its ring.
inline std::size_t following(const NumberedRing& ring, std::size_t corner) {
  return ring[corner + 1 < ring.size() ? corner + 1 : 0];
}
inline std::size_t preceding(const NumberedRing& ring, std::size_t corner) {
  return ring[corner > 0 ? corner - 1 : ring.size() - 1];
}

/// Whether a ring that meets itself nowhere runs counter-clockwise (1), clockwise (−1), or has no
/// area (0).
int direction_of(const NumberedRing& ring, const PointOrder& points);

}  // namespace fathom::clipping
