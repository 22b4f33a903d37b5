#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fathom/camera/lens.h"
#include "fathom/numeric/exact_polynomial.h"
#include "fathom/numeric/interval.h"
#include "fathom/numeric/standard_arithmetic.h"

/// The stage S of the specification (section 2), over any arithmetic T:
///   (x, y) ↦ (x·L + 2p1·xy + p2·(q + 2x²) + s1·q + s2·q²,
///             y·L + p1·(q + 2y²) + 2p2·xy + s3·q + s4·q²),  q = x² + y², L = N(q)/D(q)
/// RAD_TAN_THIN_PRISM_FISHEYE has two stages, of which the first is radial. Here S is both.
namespace fathom::lens {

/// The numbers of a stage.
template <class T>
struct StageNumbers {
  /// N and D by ascending powers of q: 1, k1, k2, … and 1, l1, l2, …
  std::vector<T> numerator, denominator;
  T p1, p2, s1, s2, s3, s4;
  /// N₁ of a first stage m ↦ m·N₁(|m|²); empty if there is none. N and D are 1 otherwise.
  std::vector<T> before{};

  bool operator==(const StageNumbers&) const = default;

  /// Whether there are two stages.
  [[nodiscard]] bool is_double() const { return !before.empty(); }

  /// The same numbers in another arithmetic.
  template <class Convert>
  [[nodiscard]] auto in(const Convert& convert) const {
    using Other = decltype(convert(p1));
    const auto all = [&convert](const std::vector<T>& numbers) {
      std::vector<Other> converted;
      converted.reserve(numbers.size());
      for (const T& number : numbers) converted.push_back(convert(number));
      return converted;
    };
    return StageNumbers<Other>{all(numerator), all(denominator), convert(p1),
                               convert(p2),    convert(s1),      convert(s2),
                               convert(s3),    convert(s4),      all(before)};
  }
};

/// The same numbers as constant polynomials.
template <class T>
StageNumbers<ExactPolynomial> as_polynomials(const StageNumbers<T>& numbers) {
  return numbers.in([](const T& number) { return ExactPolynomial(number); });
}

/// The first of two stages, by itself.
template <class T>
StageNumbers<T> first_stage(const StageNumbers<T>& n) {
  const T zero = n.p1 - n.p1;
  return {n.before, n.denominator, zero, zero, zero, zero, zero, zero};
}
/// The second of two stages, by itself.
template <class T>
StageNumbers<T> second_stage(StageNumbers<T> n) {
  n.before.clear();
  return n;
}

/// |m·N₁|² of a first stage where |m|² = q.
template <class T>
T image_of_circle(const StageNumbers<T>& n, const T& q) {
  const T factor = horner(n.before, q);
  return q * factor * factor;
}

/// The stage of a model that has one. Leading zeroes of N and D are left out, and a stage of two
/// that changes nothing.
StageNumbers<double> stage_of(const Lens& lens);

/// Whether L is all that there is.
bool is_radial(const StageNumbers<double>& numbers);
/// Whether the stage changes nothing.
bool is_identity(const StageNumbers<double>& numbers);

template <class T>
struct StagePoint {
  T x, y;
};

/// A matrix [[xx, xy], [yx, yy]]; xy is the derivative of x by y.
template <class T>
struct StageJacobian {
  T xx, xy, yx, yy;
};

/// Of a stage without another before it.
template <class T>
StagePoint<T> single_stage_value(const StageNumbers<T>& n, const T& x, const T& y) {
  const T xx = x * x, yy = y * y, xy = x * y, q = xx + yy;
  const T L = horner(n.numerator, q) / horner(n.denominator, q);
  return {x * L + (n.p1 + n.p1) * xy + n.p2 * (q + xx + xx) + q * (n.s1 + n.s2 * q),
          y * L + n.p1 * (q + yy + yy) + (n.p2 + n.p2) * xy + q * (n.s3 + n.s4 * q)};
}

template <class T>
StagePoint<T> stage_value(const StageNumbers<T>& n, const T& x, const T& y) {
  if (!n.is_double()) return single_stage_value(n, x, y);
  const T factor = horner(n.before, x * x + y * y);
  return single_stage_value<T>(n, x * factor, y * factor);
}

/// p'(x), with the derivative of the scheme of Horner.
template <class T>
T horner_derivative(const std::vector<T>& coefficients, const T& x) {
  T value = coefficients.back(), derivative = value - value;
  for (std::size_t i = coefficients.size() - 1; i-- > 0;) {
    derivative = derivative * x + value;
    value = value * x + coefficients[i];
  }
  return derivative;
}

/// With ∇q = 2m: J = L·I + m·(2L'm + 2p)ᵀ + (2p·m)·I + (b + q·b')·2mᵀ, p = (p2, p1),
/// b = p + (s1 + s2·q, s3 + s4·q).
template <class T>
StageJacobian<T> single_stage_jacobian(const StageNumbers<T>& n, const T& x, const T& y) {
  const T q = x * x + y * y;
  const T N = horner(n.numerator, q), D = horner(n.denominator, q), L = N / D;
  const T slope = (horner_derivative(n.numerator, q) - L * horner_derivative(n.denominator, q)) / D;
  const T A = L + (n.p2 + n.p2) * x + (n.p1 + n.p1) * y;
  const T gx = slope * x + n.p2, gy = slope * y + n.p1;
  const T two_q = q + q;
  const T bx = n.p2 + n.s1 + two_q * n.s2, by = n.p1 + n.s3 + two_q * n.s4;
  const T x2 = x + x, y2 = y + y;
  return {A + x2 * (gx + bx), x2 * gy + y2 * bx, y2 * gx + x2 * by, A + y2 * (gy + by)};
}

/// Of two stages, the product of the Jacobians.
template <class T>
StageJacobian<T> stage_jacobian(const StageNumbers<T>& n, const T& x, const T& y) {
  if (!n.is_double()) return single_stage_jacobian(n, x, y);
  const T q = x * x + y * y, factor = horner(n.before, q), slope = horner_derivative(n.before, q);
  const T of_x = (slope + slope) * x, across = of_x * y;
  const StageJacobian<T> first{factor + of_x * x, across, across, factor + (slope + slope) * y * y};
  const StageJacobian<T> second = single_stage_jacobian<T>(n, x * factor, y * factor);
  return {second.xx * first.xx + second.xy * first.yx, second.xx * first.xy + second.xy * first.yy,
          second.yx * first.xx + second.yy * first.yx, second.yx * first.xy + second.yy * first.yy};
}

/// The terms of D with their magnitudes.
template <class T>
T denominator_magnitude(const StageNumbers<T>& n, const T& x, const T& y) {
  using std::abs;
  std::vector<T> sizes;
  sizes.reserve(n.denominator.size());
  for (const T& number : n.denominator) sizes.push_back(abs(number));
  return horner(sizes, x * x + y * y);
}

/// The terms of stage_value() with their magnitudes: the result of binary64 arithmetic errs by at
/// most a small number of units of roundoff times these. |D| is at least `least_D` there. T is a
/// type with abs().
template <class T>
StagePoint<T> stage_magnitudes(const StageNumbers<T>& n, const T& x, const T& y, const T& least_D) {
  using std::abs;
  const StageNumbers<T> sizes = n.in([](const T& number) -> T { return abs(number); });
  const T growth = denominator_magnitude(n, x, y) / least_D;  // how much of D cancels
  StageNumbers<T> without_denominator = sizes;
  without_denominator.denominator = {least_D / growth};
  return stage_value<T>(without_denominator, abs(x), abs(y));
}
template <class T>
StagePoint<T> stage_magnitudes(const StageNumbers<T>& n, const T& x, const T& y) {
  using std::abs;
  return stage_magnitudes<T>(n, x, y, abs(horner(n.denominator, x * x + y * y)));
}

// Constants of the bounds below; validation/proofs/lenses/ proves each, in the file that is named
// beside it.
namespace bounds {
/// Covers the roundings of a few operations of binary64 on positive numbers (lens_room).
inline constexpr double up = 1 + 0x1p-40;
/// The error of stage_value() in units of roundoff: for each degree of N or D (lens_polynomial,
/// lens_factor), and what else there is (lens_stage), if the magnitudes of the terms of D add up to
/// at most so many times D (lens_factor). Two stages err by twice that, for the degree of the first
/// (lens_second).
inline constexpr double of_degree = 8, of_stage = 16;
inline constexpr double most_growth = 0x1p42;
/// Ends of intervals are moved outwards by so much of themselves (lens_interval).
inline constexpr double interval_room = 2 * unit_roundoff<double>;
}  // namespace bounds

/// What is known of a stage S on a box of the plane, for certificates in binary64.
struct StageBounds {
  /// (S(m) − S(m'))·(m − m') ≥ growth·|m − m'|² for all m and m' in the box: a lower bound on the
  /// least eigenvalue of the symmetric part of the Jacobian. 0: nothing is known.
  double growth = 0;
  /// A bound on the magnitudes of the terms of each component of S in the box, added up.
  double terms = 0;
  /// So many units of roundoff of `terms` bound the error of stage_value() in binary64, with any of
  /// its products and sums fused or not.
  double roundings = 0;
};

/// Of a box with finite ends.
StageBounds bounds_on_box(const StageNumbers<double>& stage, const std::array<Interval, 2>& box);

/// A bound on |S(m)| where |m|² = q; +∞ if none is known.
double greatest_on_circle(const StageNumbers<double>& stage, double q);

}  // namespace fathom::lens
