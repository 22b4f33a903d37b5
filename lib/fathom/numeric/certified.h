#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/ratio.h"

/// Certified decisions: an interval filter in binary64 first, exact arithmetic where the filter
/// does not settle it. No decision is ever made by a tolerance.
namespace fathom {

/// How many decisions each tier settled. Passed along explicitly; there is no global counter.
struct TierCounts {
  std::uint64_t interval = 0;
  std::uint64_t exact = 0;

  TierCounts& operator+=(const TierCounts& other) {
    interval += other.interval;
    exact += other.exact;
    return *this;
  }
};

using ExactVector3 = std::array<Dyadic, 3>;

ExactVector3 cross(const ExactVector3& a, const ExactVector3& b);
Dyadic dot(const ExactVector3& a, const ExactVector3& b);

/// The least vector of integers with the direction of v (divide_by_common_factor()).
ExactVector3 without_common_factor(ExactVector3 v);

/// Row i of the cofactors is the cross product of the other two rows, in cyclic order.
std::array<ExactVector3, 3> cofactors(const std::array<ExactVector3, 3>& rows);

/// det(a, b, c), exactly; a, b, c are the columns (or the rows).
Dyadic determinant(const ExactVector3& a, const ExactVector3& b, const ExactVector3& c);
/// The sign of det(a, b, c).
Sign sign_of_determinant(const ExactVector3& a, const ExactVector3& b, const ExactVector3& c,
                         TierCounts& counts);

/// The sign of the turn a → b → c in the plane: positive if c lies left of ab with y up.
/// Decided by CGAL's filtered orientation predicate; exact for all finite coordinates.
Sign orientation(const std::array<double, 2>& a, const std::array<double, 2>& b,
                 const std::array<double, 2>& c);

/// Whether the edges of a closed ring in the plane meet nowhere but neighbours in their corner, by
/// CGAL's sweep over the plane with that predicate.
/// Cost     n log n of n corners
bool is_simple_ring(const std::vector<std::array<double, 2>>& corners);

/// A linear form with exact coefficients and an enclosure of them for the filter. Its value at a
/// sample of an image of straight edges is l_u·u + l_v·v + l_w (u, v in pixels); at a ray it is
/// l·d with the direction d. Edge functions, and the numerators and denominators of everything that
/// is interpolated over a triangle, have this form.
class LinearForm {
 public:
  LinearForm() : LinearForm(ExactVector3{}) {}
  explicit LinearForm(ExactVector3 coefficients);

  [[nodiscard]] const ExactVector3& coefficients() const { return coefficients_; }
  /// Whether the value is 0 everywhere.
  [[nodiscard]] bool is_zero() const;
  LinearForm operator-() const;
  /// The exact value at the sample (u, v); u and v finite.
  [[nodiscard]] Dyadic at(double u, double v) const;
  /// An interval that contains the value at (u, v).
  [[nodiscard]] Interval enclose_at(double u, double v) const;
  /// An interval that contains l_u·U + l_v·V + l_w·W for every point (U, V, W) of a box.
  [[nodiscard]] Interval enclose_at(const std::array<Interval, 3>& box) const;
  /// The sign of the value at (u, v).
  [[nodiscard]] Sign sign_at(double u, double v, TierCounts& counts) const;

 private:
  ExactVector3 coefficients_;
  /// Intervals that contain the coefficients.
  std::array<Interval, 3> enclosures_;
  bool filterable_ = false;
};

/// An interval that contains every quotient of a member of `a` and a member of `b`;
/// [−∞, ∞] if b contains 0.
Interval quotient(const Interval& a, const Interval& b);

}  // namespace fathom
