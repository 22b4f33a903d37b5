#pragma once

#include <cstdint>
#include <vector>

namespace fathom::fast {

struct SquarePoint {
  double x, y;
};

/// Line segments that cross the unit square, cut into slabs of heights within which none of them
/// ends and, but for rounding, no two cross each other or a side of the square. A length along a
/// horizontal line that is decided by the order of the crossings is linear in the height there.
///
/// Let X ≥ 1 bound the x of the segments' ends, u be the unit roundoff.
/// 1. x at a height y of an edge is computed as x₀ + (y − y₀)·s with s = (x₁ − x₀)/(y₁ − y₀), y
///    between y₀ and y₁. s has a relative error of 3.01u, the difference u, the product u, together
///    5.1u·|x₁ − x₀| ≤ 10.2uX, and the sum 3uX more: ξ = 16uX covers it.
/// 2. Breaks at ends are exact. Where the computed distance of two edges has opposite signs at the
///    ends of their common heights, a break is set where the linear interpolation of these two
///    distances vanishes. The true distance differs from that by at most 2ξ everywhere, so it is at
///    most 2ξ at that place, which is computed with an error of at most 8u. Where the signs are not
///    opposite, the distance does not fall below −2ξ on the other side. The same for an edge and a
///    side of the square.
/// 3. So in a slab, but for the 8u at its two ends, any two crossings that stand in another order
///    somewhere than at mid-height differ there by at most 4ξ. Sorting them as at mid-height moves
///    each by at most 4ξ (running maximum).
/// 4. A length that changes by no more than a crossing is moved, and that with the order fixed is a
///    linear combination of crossings, therefore differs from a linear function that has the value
///    at mid-height by at most 8nξ, n the number of crossings and of sides of the square, and the
///    value computed at mid-height by nξ more.
/// 5. The 8u at both ends of a slab, times a length of at most 1: 16u a slab. A slab too thin for
///    its middle to lie inside it is left out: 2u. An edge that rises by less than 2⁻⁶⁰ is left
///    out, but for breaks at its ends: it is met in a slab no higher than that.
///    Products and sums: 4u a slab.
/// Together 9nξ + 32u per slab; error_of() gives 10nξ and that.
class SquareEdges {
 public:
  struct Edge {
    double x, y, slope;  // x at height y, and by how much it grows with the height
    double low, high;    // heights within the square, low < high
    double x_low, x_high;
    std::int32_t tag;
    [[nodiscard]] double at(double height) const { return x + (height - y) * slope; }
  };

  void clear();
  /// A segment between points that may lie outside the square. The tag is the caller's.
  void add(const SquarePoint& p, const SquarePoint& q, std::int32_t tag);
  /// After the last edge. Edges with the same tag are taken not to cross where `apart` is set.
  void cut(bool tags_apart);

  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// Sum over the slabs of height times length(height in the middle).
  template <class Length>
  double integrate(const Length& length) const {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
      const double low = breaks_[i], high = breaks_[i + 1];
      const double middle = low + (high - low) / 2;
      if (low < middle && middle < high) sum += (high - low) * length(middle);
    }
    return sum;
  }
  /// Of integrate(), where lines cross edges and sides so often at most.
  [[nodiscard]] double error_of(std::size_t crossings) const;

 private:
  void add_crossing(const Edge& a, const Edge& b);

  std::vector<Edge> edges_;
  std::vector<const Edge*> inside_;
  /// Heights of the ends of edges that are left out.
  std::vector<double> level_;
  std::vector<double> breaks_;
  double extent_ = 1;
};

}  // namespace fathom::fast
