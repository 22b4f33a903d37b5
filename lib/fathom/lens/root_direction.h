#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <variant>

#include "fathom/camera/lens.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"

/// Directions whose components have square roots: the lenses UCM, EUCM, OMNI and DOUBLE_SPHERE, and
/// the orthographic and equisolid fisheyes.
namespace fathom::lens {

/// The vector a + b·√s, over any arithmetic.
template <class T>
struct RootVector {
  std::array<T, 3> a, b;
  T s;

  /// The same vector in another arithmetic.
  template <class Convert>
  [[nodiscard]] auto in(const Convert& convert) const {
    return RootVector<decltype(convert(s))>{{convert(a[0]), convert(a[1]), convert(a[2])},
                                            {convert(b[0]), convert(b[1]), convert(b[2])},
                                            convert(s)};
  }
  /// The components; s > 0.
  [[nodiscard]] std::array<T, 3> components() const {
    using std::sqrt;
    const T root = sqrt(s);
    return {a[0] + b[0] * root, a[1] + b[1] * root, a[2] + b[2] * root};
  }
};

/// The vector a + b·√t with a, b and t = t_plain + t_root·√s over the numbers p + q·√s, in any
/// arithmetic.
template <class T>
struct NestedRootVector {
  RootVector<T> a, b;
  T t_plain, t_root, s;

  /// The same vector in another arithmetic.
  template <class Convert>
  [[nodiscard]] auto in(const Convert& convert) const {
    return NestedRootVector<decltype(convert(s))>{a.in(convert), b.in(convert), convert(t_plain),
                                                  convert(t_root), convert(s)};
  }
  /// The components; s > 0 and t > 0.
  [[nodiscard]] std::array<T, 3> components() const {
    const auto of_a = a.components(), of_b = b.components();
    using std::sqrt;
    const T root = sqrt(t_plain + t_root * sqrt(s));
    return {of_a[0] + of_b[0] * root, of_a[1] + of_b[1] * root, of_a[2] + of_b[2] * root};
  }
};

/// The formula of the models with one root. The sample that K⁻¹ takes to y = (y.a, y.b)/y.c sees,
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

/// The formula of DOUBLE_SPHERE. With p and s as above, D = (1 − α)·y.c + α·√s, N = y.c² − α²·p and
/// t = N² + (1 − ξ²)·p·D², a positive multiple of the specification's d is
///   ((y.a, y.b)·D·(ξ·N + √t), N·√t − ξ·p·D²).
template <class T>
struct DoubleSphereFormula {
  T alpha, rest_of_alpha, alpha_squared, under, xi, rest_of_xi_squared, zero;

  /// The same formula in another arithmetic.
  template <class Convert>
  [[nodiscard]] auto in(const Convert& convert) const {
    return DoubleSphereFormula<decltype(convert(alpha))>{
        convert(alpha), convert(rest_of_alpha),      convert(alpha_squared), convert(under),
        convert(xi),    convert(rest_of_xi_squared), convert(zero)};
  }

  [[nodiscard]] NestedRootVector<T> at(const HomogeneousPoint<T>& y) const {
    const T p = y.a * y.a + y.b * y.b, c_squared = y.c * y.c, s = c_squared + under * p;
    const T N = c_squared - alpha_squared * p, D = rest_of_alpha * y.c;
    // D² = squared_plain + squared_root·√s
    const T squared_plain = D * D + alpha_squared * s, product = alpha * D;
    const T squared_root = product + product;
    const T of_N = xi * N, of_p = xi * p, of_t = rest_of_xi_squared * p;
    const RootVector<T> b{{y.a * D, y.b * D, N}, {y.a * alpha, y.b * alpha, zero}, s};
    return {{{b.a[0] * of_N, b.a[1] * of_N, -(of_p * squared_plain)},
             {b.b[0] * of_N, b.b[1] * of_N, -(of_p * squared_root)},
             s},
            b,
            N * N + of_t * squared_plain,
            of_t * squared_root,
            s};
  }
};

template <class T>
using AnyRootFormula = std::variant<RootFormula<T>, DoubleSphereFormula<T>>;

/// The same formula in another arithmetic.
template <class Convert>
auto converted(const AnyRootFormula<Dyadic>& formula, const Convert& convert) {
  using T = decltype(convert(Dyadic()));
  return std::visit([&](const auto& f) { return AnyRootFormula<T>(f.in(convert)); }, formula);
}

/// The formula of a lens; nullopt if its model has none with a root.
std::optional<AnyRootFormula<Dyadic>> root_formula(const Lens& lens);

/// Where the image of a lens with a root ends, as distances r from its axis, r² = x_d² + y_d².
class RootProfile {
 public:
  explicit RootProfile(const AnyRootFormula<Dyadic>& formula);

  /// Samples have rays below it; +∞ if there is no end. In binary64, with some roundings.
  [[nodiscard]] double end() const { return end_; }
  /// The r < end() of the directions at an angle to the axis; nullopt if the lens does not reach
  /// the angle below `farthest`. In binary64, with some roundings.
  [[nodiscard]] std::optional<double> radius_at(double angle, double farthest) const;

 private:
  [[nodiscard]] double angle_at(double radius) const;

  AnyRootFormula<double> formula_;
  double end_;
};

/// The sign of p + q·√s; s > 0.
Sign sign_with_root(const Dyadic& p, const Dyadic& q, const Dyadic& s);

/// The direction d of a ray of such a lens, a RootVector<Dyadic> or a NestedRootVector<Dyadic>.
///
/// Exact    a form at a + b·√s is p + q·√s, and so is a quadratic form; squares show its sign.
///          Where p, q and s are such numbers themselves, squares show these signs, too.
template <class Vector>
class RootDirection {
 public:
  /// A positive multiple of `d`, whose greatest component is about 1.
  /// Needs    d.s > 0, a d other than 0, and a component x or y other than 0.
  explicit RootDirection(Vector d);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses the components of d, with a precision of about `bits` relative to 1, of x and y
  /// relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Binary64 intervals that contain d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  Vector d_;
  std::array<Interval, 3> box_;
};

using OneRootDirection = RootDirection<RootVector<Dyadic>>;
using NestedRootDirection = RootDirection<NestedRootVector<Dyadic>>;

}  // namespace fathom::lens
