#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/numeric/standard_arithmetic.h"

// Constants of the bounds on areas; their derivations are where they are used.
// validation/proofs/areas/area_*.gappa.in proves each.
namespace fathom::fast::area_bounds {

/// x of an edge at a height, in units of its greatest |x| (SquareEdges).
inline constexpr double crossing_error = 16 * unit_roundoff<double>;
/// The effect on an area, over ε, of moving the ends of an edge, or the corners of a triangle, by
/// ε.
inline constexpr double moved_edge = 4.1, moved_triangle = 16;
/// The same for an edge, over ε times its length near the square, and for its ends, over ε².
inline constexpr double moved_length = 2.83, moved_end = 6.3;
/// A cut by a line: error/max(|a|, |b|), and its own roundings (pixel_area.cpp).
inline constexpr double cut_error = 8, cut_rounding = 64 * unit_roundoff<double>;

/// Coordinates of at most `far` pixels are computed within rounding_room, also along edges whose
/// ends differ by least_rise in height (tile_outlines.cpp; row_of_edge).
inline constexpr double far = 0x1p28, rounding_room = 0x1p-20, least_rise = 0x1p-20;

}  // namespace fathom::fast::area_bounds

namespace fathom::fast {

struct SquarePoint {
  double x, y;
};

/// Line segments that cross the unit square, swept from top to bottom in slabs: ranges of heights
/// in which no segment ends and, except for rounding, no two segments cross each other or a side of
/// the square. There, a length along a horizontal line that depends on the order of the crossings
/// is linear in the height.
///
/// Let X ≥ 1 bound the x of the segments' ends, and u be the unit roundoff.
/// 1. x at a height y of an edge is computed as x₀ + (y − y₀)·s with s = (x₁ − x₀)/(y₁ − y₀), y
///    between y₀ and y₁. s has a relative error of 3.01u, the difference u, the product u, together
///    5.1u·|x₁ − x₀| ≤ 10.2uX, and the sum 3uX more: ξ = 16uX covers it.
/// 2. Breaks at ends are exact. Where the computed distance of two edges has opposite signs at two
///    successive ends, a break is set where the linear interpolation of these two distances
///    vanishes. The true distance differs from the interpolation by at most 2ξ everywhere, so it is
///    at most 2ξ at the break, whose height is computed with an error of at most 8u. Where the
///    signs are not opposite, the distance does not fall below −2ξ on the other side. The same
///    holds for an edge and a side of the square.
/// 3. So in a slab, except for the 8u at its two ends, any two crossings whose order somewhere
///    differs from their order at mid-height differ there by at most 4ξ. Sorting them as at
///    mid-height moves each by at most 4ξ (running maximum).
/// 4. Consider a length that changes by at most the distance by which a crossing is moved, and that
///    is a linear combination of the crossings while their order is fixed. It therefore differs by
///    at most 8nξ from a linear function with its value at mid-height, where n is the number of
///    crossings and of sides of the square; the value computed at mid-height adds nξ. An edge whose
///    computed x is below −4ξ at two successive ends, or above 1 + 4ξ at both, lies beyond that
///    side between them and does not count. If all edges do, the length is constant, and no break
///    is set.
/// 5. The 8u at both ends of a slab, times a length of at most 1: 16u per slab that an edge may
///    meet. A slab too thin for its middle to lie inside it is left out: 2u. An edge that rises by
///    less than 2⁻⁶⁰ is left out, except for breaks at its ends: the slab in which it is met is no
///    higher than 2⁻⁶⁰. Products and sums: 4u of the sum per slab.
/// Together: 9nξ times the heights in which edges may be met; 32u per slab there, per thin slab and
/// per level edge; and 4u of the sum per slab. error() returns these terms, with 10nξ in place of
/// 9nξ.
///
/// If the length is all or nothing between two successive ends, because all edges together cannot
/// change the quantity that it depends on, neither order nor place of the edges matters.
///
/// Between two successive ends where a single edge may be met, nothing depends on an order:
/// 6. In a slab the edge's x differs from what of it is within the square by at most 4ξ if that is
///    so in the middle, and is otherwise within 4ξ of a side: 5ξ with the value computed at
///    mid-height, for which error() has 6ξ. The 8u at an end count times what the length varies
///    there, 4ξ and the slope times 8u: up to a slope of 2²⁰ that is less than 2⁻²⁹, and u per slab
///    is more than enough.
class SquareEdges {
 public:
  struct Edge {
    double x, y, slope;  // x at height y, and by how much it grows with the height
    double low, high;    // heights within the square, low < high
    double x_low, x_high;
    std::int32_t tag;
    [[nodiscard]] double at(double height) const { return x + (height - y) * slope; }
  };
  /// Where an edge crosses the middle of a slab.
  struct Crossing {
    double x;
    std::int32_t tag;
    /// x < 0.
    bool is_left;
    // For the sweep: the edge, and its x at the two breaks around the slab.
    const Edge* edge;
    double x_low, x_high;
  };
  struct Slab {
    double thickness, middle;
    /// In the order of their x.
    std::span<const Crossing> crossings;
    /// The sum of the tags of edges that have moved, from the top to here, from the right to the
    /// left of x = 0, minus the tags of edges that have moved from the left to the right. If a tag
    /// is the increase of a quantity from the left of the edge to its right, then the quantity has
    /// increased by `passed` at x = 0 (at the left of x = 0, if edges pass through it).
    std::int32_t passed;
  };

  /// The heights between two successive ends, before they are cut into slabs.
  struct Strip {
    double thickness;
    /// As in a slab, at the upper end.
    std::int32_t passed;
    /// The least and the greatest increase of such a quantity from x = 0 at the upper end to any
    /// point of the square in the strip.
    std::int32_t least, greatest;
  };

  void clear();
  /// A segment between points that may lie outside the square. The tag is for the caller's use.
  void add(const SquarePoint& p, const SquarePoint& q, std::int32_t tag);

  /// The edges that are neither level nor certainly outside the square.
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// Calls visit(Slab) for one slab after another while it returns true, except for slabs in strips
  /// for which decide(Strip) returns true.
  template <class Decide, class Visit>
  void for_each_slab(const Decide& decide, const Visit& visit);
  /// The sum over the slabs of thickness times length(Slab); and over strips of thickness times
  /// length_in(Strip), if this is not negative: then it is the length throughout the strip.
  template <class LengthIn, class Length>
  double integrate(const LengthIn& length_in, const Length& length);
  /// The error of the last integrate(), which returned the sum.
  [[nodiscard]] double error(double sum) const;
  /// ξ.
  [[nodiscard]] double crossing_error() const;

 private:
  struct Level {
    double low, high;
    std::int32_t passed;
  };
  void start();
  void enter(double low, double high);
  /// Whether no point of the edge between the last two breaks is in the square.
  [[nodiscard]] bool is_beyond_a_side(const Crossing& crossing) const;
  [[nodiscard]] Strip strip(double thickness) const;
  void leave_undivided();
  void find_cuts(double low, double high);
  /// For the heights between the last two breaks.
  void add_errors(double heights);
  void add_cut(double low, double high, double d_low, double d_high);
  void move_to(double height);
  void look_at_side(Crossing& crossing, bool is_left) {
    if (crossing.is_left == is_left) return;
    passed_ += is_left ? crossing.tag : -crossing.tag;
    crossing.is_left = is_left;
  }

  std::vector<Edge> edges_;
  std::vector<Level> level_;
  double extent_ = 1;
  // For the sweep:
  std::vector<const Edge*> waiting_;
  std::vector<double> breaks_;
  std::size_t next_edge_ = 0, next_level_ = 0;
  std::vector<Crossing> crossings_;
  std::vector<double> cuts_;
  std::int32_t passed_ = 0;
  std::size_t slabs_ = 0;
  /// The error so far, over u and over ξ.
  double in_u_ = 0, in_xi_ = 0;
};

template <class Decide, class Visit>
void SquareEdges::for_each_slab(const Decide& decide, const Visit& visit) {
  start();
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) {
    double low = breaks_[i];
    const double end = breaks_[i + 1];
    enter(low, end);
    if (decide(strip(end - low))) {
      leave_undivided();
      continue;
    }
    find_cuts(low, end);
    add_errors(end - low);
    for (std::size_t k = 0; k <= cuts_.size(); ++k) {
      const double high = k < cuts_.size() ? cuts_[k] : end, middle = low + (high - low) / 2;
      if (low < middle && middle < high) {
        move_to(middle);
        if (!visit(Slab{high - low, middle, crossings_, passed_})) return;
      } else {
        in_u_ += 2;
      }
      low = high;
    }
  }
}

template <class LengthIn, class Length>
double SquareEdges::integrate(const LengthIn& length_in, const Length& length) {
  double sum = 0;
  const auto decide = [&](const Strip& strip) {
    const double its_length = length_in(strip);
    if (its_length >= 0) sum += strip.thickness * its_length;
    return its_length >= 0;
  };
  for_each_slab(decide, [&](const Slab& slab) {
    sum += slab.thickness * length(slab);
    return true;
  });
  return sum;
}

}  // namespace fathom::fast
