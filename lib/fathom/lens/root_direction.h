#pragma once

#include <array>
#include <optional>

#include "fathom/camera/lens.h"
#include "fathom/lens/direction_words.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"

/// Directions whose components have a square root: the lenses UCM, EUCM and OMNI, and the
/// orthographic and equisolid fisheyes.
namespace fathom::lens {

/// The vector a + b·√s, over any arithmetic.
template <class T>
struct RootVector {
  std::array<T, 3> a, b;
  T s;
};

/// The formula that all these lenses share. The sample that K⁻¹ takes to y = (y.a, y.b)/y.c sees,
/// with p = y.a² + y.b², s = y.c² + under·p and a positive factor,
///   d = ((y.a, y.b)·(aside·y.c + aside_root·√s), ahead·y.c² + bend·p + ahead_root·y.c·√s),
/// if s > 0; otherwise it has no ray.
template <class T>
struct RootFormula {
  T aside, aside_root, ahead, bend, ahead_root, under;

  /// The same formula in another arithmetic.
  template <class Convert>
  [[nodiscard]] auto in(const Convert& convert) const {
    return RootFormula<decltype(convert(aside))>{convert(aside),      convert(aside_root),
                                                 convert(ahead),      convert(bend),
                                                 convert(ahead_root), convert(under)};
  }

  [[nodiscard]] RootVector<T> at(const HomogeneousPoint<T>& y) const {
    const T p = y.a * y.a + y.b * y.b, c_squared = y.c * y.c;
    const T of_c = aside * y.c;
    return {{y.a * of_c, y.b * of_c, ahead * c_squared + bend * p},
            {y.a * aside_root, y.b * aside_root, ahead_root * y.c},
            c_squared + under * p};
  }
};

/// The formula of a lens; nullopt if its model has none with a root.
std::optional<RootFormula<Dyadic>> root_formula(const Lens& lens);

/// Where the image of a lens with a root ends, as distances r from its axis, r² = x_d² + y_d².
class RootProfile {
 public:
  explicit RootProfile(const RootFormula<Dyadic>& formula);

  /// Samples have rays below it; +∞ if there is no end. In binary64, with some roundings.
  [[nodiscard]] double end() const { return end_; }
  /// The r < end() of the directions at an angle to the axis; nullopt if the lens does not reach
  /// the angle below `farthest`. In binary64, with some roundings.
  [[nodiscard]] std::optional<double> radius_at(double angle, double farthest) const;

 private:
  [[nodiscard]] double angle_at(double radius) const;

  RootFormula<double> formula_;
  double end_;
};

/// The direction d of a ray of such a lens.
///
/// Exact    d = a + b·√s with dyadic a, b and s. A form at d is p + q·√s, and so is a quadratic
///          form; squares show its sign.
class RootDirection {
 public:
  /// A positive multiple of `d`, whose greatest component is about 1.
  /// Needs    d.s > 0, a d other than 0, and a component x or y other than 0.
  explicit RootDirection(RootVector<Dyadic> d);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses the components of d, with a precision of about `bits` relative to 1, of x and y
  /// relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// d in double-words, from an enclosure.
  [[nodiscard]] std::optional<DirectionWords> words() const;
  /// Binary64 intervals that contain d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  RootVector<Dyadic> d_;
  std::array<Interval, 3> box_;
};

}  // namespace fathom::lens
