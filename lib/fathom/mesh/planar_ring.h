#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/standard_arithmetic.h"

/// The projection of a face to a plane: tests of its shape, and a search for its corners. Every
/// test is exact.
namespace fathom::mesh {

using Point2 = std::array<double, 2>;
/// The number of a corner in the face.
using Corner = std::uint32_t;

/// The sign of the turn a → b → c, as orientation() computes it; binary64 settles most signs
/// without calling it.
///
/// Bound. Each difference is rounded once, and each product, so that `left` and `right` carry
/// relative errors of at most (1+u)³ − 1 < 3.01u, u = 2⁻⁵³; their difference is rounded once more.
/// With S = |left| + |right| as computed, |error| < 3.02u·S + 1.01u·S < 5u·S. An underflowing
/// product adds at most 2⁻¹⁰⁷⁵, which S ≥ 2⁻⁹⁰⁰ makes less than u·S·2⁻¹⁰⁰; an overflow makes S
/// infinite, and no comparison holds.
inline Sign turn_of(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
  const double determinant = left - right, size = std::abs(left) + std::abs(right);
  if (size >= 0x1p-900) {
    const double bound = 5 * unit_roundoff<double> * size;
    if (determinant > bound) return Sign::positive;
    if (determinant < -bound) return Sign::negative;
  }
  return orientation(a, b, c);
}

/// Numbers of the corners that differ from the one before them; they trace the same curve.
std::vector<Corner> without_repeats(const std::vector<Point2>& points);

/// Whether the ring turns only one way or goes straight, and winds once.
/// Cost     n
bool is_convex(const std::vector<Point2>& points, const std::vector<Corner>& ring);

/// Whether the ring, in which neighbours differ, is a simple closed curve: neighbouring edges share
/// only their corner, others nothing.
/// Cost     n log n
bool is_simple(const std::vector<Point2>& points, const std::vector<Corner>& ring);

/// The way a simple ring turns.
Sign way_of(const std::vector<Point2>& points, const std::vector<Corner>& ring);

/// Corners of a face by where they lie: a k-d tree from which corners are taken.
class CornerTree {
 public:
  /// The corners are numbers of `points`, which must outlive this.
  CornerTree(const std::vector<Point2>& points, std::vector<Corner> corners);

  [[nodiscard]] bool contains(Corner corner) const { return place_[corner] != nowhere; }
  void remove(Corner corner);

  /// A corner that lies in the closed triangle abc and is at none of a, b and c; abc turns `way`,
  /// which is not zero. Exact. One of several is chosen at random, so that nobody can arrange
  /// corners for which it is always the corner that is removed next.
  [[nodiscard]] std::optional<Corner> find_in(const Point2& a, const Point2& b, const Point2& c,
                                              Sign way);

 private:
  static constexpr Corner nowhere = 0xFFFFFFFF;
  /// The corners [begin, end) of the list. The children of node k are 2k + 1 and 2k + 2.
  struct Range {
    std::size_t node, begin, end;
    [[nodiscard]] std::size_t middle() const { return begin + (end - begin) / 2; }
  };
  struct Node {
    Point2 least, greatest;
    std::uint32_t left = 0;  ///< how many corners have not been removed
  };
  class Triangle;

  void build(const Range& range, int depth);
  [[nodiscard]] bool is_leaf(const Range& range) const {
    return 2 * range.node + 1 >= nodes_.size();
  }

  const std::vector<Point2>& points_;
  std::vector<Corner> list_;
  /// The place of a corner in the list.
  std::vector<Corner> place_;
  std::vector<Node> nodes_;
  std::uint64_t questions_ = 0;
};

}  // namespace fathom::mesh
