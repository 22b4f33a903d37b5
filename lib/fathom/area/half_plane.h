#pragma once

#include <array>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/certified_arithmetic.h"

namespace fathom::area {

/// The points (u, v) with l_u·u + l_v·v + l_w ≥ 0, exactly; its line is l = 0. The normal
/// (l_u, l_v) is not zero, except in forms that are only asked for determinants.
///
/// Two half-planes a, b with turn(a, b) > 0 meet in a vertex if they are edges of a convex polygon
/// that lies inside both; edges in this order go round counter-clockwise where v grows upwards
/// (clockwise on an image, where v grows downwards; areas are not affected).
/// Exact    every sign below: binary64 with a proved bound first, exact numbers where it fails.
class HalfPlane {
 public:
  /// Takes a power of two out of the coefficients, so that the greatest is just below 1.
  explicit HalfPlane(ExactVector3 l);

  [[nodiscard]] const ExactVector3& exact() const { return exact_; }
  /// The given coefficients were exact()·2^exponent().
  [[nodiscard]] long exponent() const { return exponent_; }
  /// Within 2⁻⁵²·|l_k| + 2⁻¹⁰⁷⁴ of the exact coefficients; at most 1.
  [[nodiscard]] const std::array<double, 3>& approximate() const { return approximate_; }

 private:
  ExactVector3 exact_;
  long exponent_ = 0;
  std::array<double, 3> approximate_;
};

/// l_u, l_v or l_w for k = 0, 1, 2.
Certified<double> approximate_coefficient(const HalfPlane& l, std::size_t k);

/// a_u·b_v − a_v·b_u: positive if the line of b turns left from the line of a, 0 if they are
/// parallel.
Certified<double> approximate_turn(const HalfPlane& a, const HalfPlane& b);
Dyadic turn(const HalfPlane& a, const HalfPlane& b);
Sign sign_of_turn(const HalfPlane& a, const HalfPlane& b, TierCounts& counts);

/// det(a, b, c): 0 if the three lines meet in one point, or if they are parallel.
Certified<double> approximate_determinant(const HalfPlane& a, const HalfPlane& b,
                                          const HalfPlane& c);
Dyadic determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c);
Sign sign_of_determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c,
                         TierCounts& counts);

/// Whether the parallel lines of a and b have their insides on the same side.
bool same_side(const HalfPlane& a, const HalfPlane& b);

/// Walk along the line of e with the inside of e on the left. The line of m, if not parallel to it,
/// is crossed at a place τ, in units of the normal's length; there the walk enters m if
/// turn(e, m) < 0, and leaves it otherwise.

/// The sign of τ(m) − τ(n).
Sign compare_crossings(const HalfPlane& e, const HalfPlane& m, const HalfPlane& n,
                       TierCounts& counts);
/// The sign of m at the place where e crosses `at`.
Sign side_of_crossing(const HalfPlane& m, const HalfPlane& e, const HalfPlane& at,
                      TierCounts& counts);

}  // namespace fathom::area
