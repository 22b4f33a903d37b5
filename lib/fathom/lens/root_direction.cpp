#include "fathom/lens/root_direction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fathom/lens/form_values.h"
#include "fathom/numeric/big_interval.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

/// d = (x_d, y_d, (1 − α²βr²)/(αS + 1 − α)) with S = √(1 + (1 − 2α)βr²), times the denominator.
RootFormula<Dyadic> formula_of_eucm(const Dyadic& alpha, const Dyadic& beta) {
  const Dyadic one = 1.0;
  return {.aside = one - alpha,
          .aside_root = alpha,
          .ahead = one,
          .bend = -(alpha * alpha * beta),
          .ahead_root = 0.0,
          .under = (one - alpha - alpha) * beta};
}

/// d = ((x_d, y_d)·(ξ + S), S − ξr²) with S = √(1 + (1 − ξ²)r²).
RootFormula<Dyadic> formula_of_omni(const Dyadic& xi) {
  return {.aside = xi,
          .aside_root = 1.0,
          .ahead = 0.0,
          .bend = -xi,
          .ahead_root = 1.0,
          .under = Dyadic(1.0) - xi * xi};
}

DoubleSphereFormula<Dyadic> formula_of_double_sphere(const Dyadic& xi, const Dyadic& alpha) {
  const Dyadic one = 1.0;
  return {.alpha = alpha,
          .rest_of_alpha = one - alpha,
          .alpha_squared = alpha * alpha,
          .under = one - alpha - alpha,
          .xi = xi,
          .rest_of_xi_squared = one - xi * xi,
          .zero = 0.0};
}

}  // namespace

std::optional<AnyRootFormula<Dyadic>> root_formula(const Lens& lens) {
  const StandardArithmetic standard;
  switch (lens.model) {
    case LensModel::fisheye_orthographic:
      return RootFormula<Dyadic>{.aside = 1.0,
                                 .aside_root = 0.0,
                                 .ahead = 0.0,
                                 .bend = 0.0,
                                 .ahead_root = 1.0,
                                 .under = -1.0};
    case LensModel::fisheye_equisolid:
      return RootFormula<Dyadic>{.aside = 0.0,
                                 .aside_root = 1.0,
                                 .ahead = 1.0,
                                 .bend = -0.5,
                                 .ahead_root = 0.0,
                                 .under = -0.25};
    case LensModel::ucm:
      return formula_of_eucm(lens.distortion[0], 1.0);
    case LensModel::eucm:
      return formula_of_eucm(lens.distortion[0], lens.distortion[1]);
    case LensModel::omni:
      return formula_of_omni(lens.distortion[0]);
    case LensModel::double_sphere:
      return formula_of_double_sphere(lens.distortion[0], lens.distortion[1]);
    default:
      return std::nullopt;
  }
}

namespace {

double end_of(const AnyRootFormula<double>& formula) {
  const double under = std::visit([](const auto& f) { return f.under; }, formula);
  return under < 0 ? 1 / std::sqrt(-under) : std::numeric_limits<double>::infinity();
}

}  // namespace

RootProfile::RootProfile(const AnyRootFormula<Dyadic>& formula)
    : formula_(converted(formula, [](const Dyadic& x) { return enclose(x).lower; })),
      end_(end_of(formula_)) {}

double RootProfile::angle_at(double radius) const {
  return std::visit(
      [radius](const auto& formula) {
        const std::array<double, 3> components = formula.at({radius, 0.0, 1.0}).components();
        return std::atan2(components[0], components[2]);
      },
      formula_);
}

std::optional<double> RootProfile::radius_at(double angle, double farthest) const {
  constexpr double below_end = 1 - 0x1p-40;  // where s is positive when rounded
  double inner = 0, outer = std::min(end_ * below_end, farthest);
  if (!std::isfinite(outer) || !(angle_at(outer) > angle)) return std::nullopt;
  constexpr int steps = 100;
  for (int i = 0; i < steps; ++i) {
    const double middle = inner + (outer - inner) / 2;
    if (!(inner < middle && middle < outer)) break;
    (angle_at(middle) > angle ? outer : inner) = middle;
  }
  return inner;
}

namespace {

template <class Vector>
std::array<DyadicInterval, 3> enclose_in_bits(const Vector& d, long bits) {
  const auto [x, y, z] =
      d.in([bits](const Dyadic& number) { return BigInterval(number, bits); }).components();
  return {x.ends(), y.ends(), z.ends()};
}

RootVector<Dyadic> scaled(RootVector<Dyadic> d, long power) {
  for (std::size_t k = 0; k < 3; ++k) {
    d.a[k] = d.a[k].scaled(power);
    d.b[k] = d.b[k].scaled(power);
  }
  return d;
}

NestedRootVector<Dyadic> scaled(NestedRootVector<Dyadic> d, long power) {
  d.a = scaled(std::move(d.a), power);
  d.b = scaled(std::move(d.b), power);
  return d;
}

/// Of the greatest component.
template <class Vector>
Vector scaled_to_about_one(Vector d) {
  const auto [x, y, z] = enclose_in_bits(d, bits_of_box);
  return scaled(std::move(d), -std::max({size_of(x), size_of(y), size_of(z)}).top());
}

/// p + q·√s
struct RootNumber {
  Dyadic p, q;
};

RootNumber operator+(const RootNumber& x, const RootNumber& y) {
  return {x.p + y.p, x.q + y.q};
}
RootNumber operator-(const RootNumber& x, const RootNumber& y) {
  return {x.p - y.p, x.q - y.q};
}
RootNumber product(const RootNumber& x, const RootNumber& y, const Dyadic& s) {
  return {x.p * y.p + x.q * y.q * s, x.p * y.q + x.q * y.p};
}

/// The sign of a number, s > 0.
Sign sign_of_number(const RootNumber& x, const Dyadic& s) {
  return sign_with_root(x.p, x.q, s);
}

/// The sign of x + y·√t, t > 0.
Sign sign_of_number(const RootNumber& x, const RootNumber& y, const RootNumber& t,
                    const Dyadic& s) {
  const Sign of_x = sign_of_number(x, s), of_y = sign_of_number(y, s);
  if (of_x == of_y || of_y == Sign::zero) return of_x;
  if (of_x == Sign::zero) return of_y;
  const RootNumber squares = product(x, x, s) - product(product(y, y, s), t, s);
  const Sign greater = sign_of_number(squares, s);
  if (greater == Sign::zero) return Sign::zero;
  return greater == Sign::positive ? of_x : of_y;
}

RootNumber value_at(const ExactVector3& form, const RootVector<Dyadic>& d) {
  return {dot(form, d.a), dot(form, d.b)};
}

ExactVector3 sum(const ExactVector3& a, const ExactVector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

// F(a + b·√s) = F(a) + F(b)·s + (F(a + b) − F(a) − F(b))·√s.
RootNumber value_at(const QuadraticForm& form, const RootVector<Dyadic>& d) {
  const Dyadic of_a = form.at(d.a), of_b = form.at(d.b);
  return {of_a + of_b * d.s, form.at(sum(d.a, d.b)) - of_a - of_b};
}

template <class Form>
Sign sign_at(const Form& form, const RootVector<Dyadic>& d) {
  return sign_of_number(value_at(form, d), d.s);
}

Sign sign_at(const ExactVector3& form, const NestedRootVector<Dyadic>& d) {
  return sign_of_number(value_at(form, d.a), value_at(form, d.b), {d.t_plain, d.t_root}, d.s);
}

Sign sign_at(const QuadraticForm& form, const NestedRootVector<Dyadic>& d) {
  const RootNumber t{d.t_plain, d.t_root};
  const RootNumber of_a = value_at(form, d.a), of_b = value_at(form, d.b);
  const RootNumber of_sum = value_at(form, {sum(d.a.a, d.b.a), sum(d.a.b, d.b.b), d.s});
  return sign_of_number(of_a + product(of_b, t, d.s), of_sum - of_a - of_b, t, d.s);
}

}  // namespace

Sign sign_with_root(const Dyadic& p, const Dyadic& q, const Dyadic& s) {
  if (p.sign() == q.sign() || q.is_zero()) return p.sign();
  if (p.is_zero()) return q.sign();
  const int greater = compare(p * p, q * q * s);
  if (greater == 0) return Sign::zero;
  return greater > 0 ? p.sign() : q.sign();
}

template <class Vector>
RootDirection<Vector>::RootDirection(Vector d) : d_(scaled_to_about_one(std::move(d))) {
  const auto [x, y, z] = enclosure(bits_of_box);
  box_ = {enclose(x), enclose(y), enclose(z)};
}

template <class Vector>
Sign RootDirection<Vector>::sign_of(const ExactVector3& form) const {
  return sign_at(form, d_);
}

template <class Vector>
Sign RootDirection<Vector>::sign_of(const QuadraticForm& form) const {
  return sign_at(form, d_);
}

template <class Vector>
std::array<DyadicInterval, 3> RootDirection<Vector>::enclosure(long bits) const {
  for (long precision = bits + bits_to_lose;; precision *= 2) {
    auto d = enclose_in_bits(d_, precision);
    if (is_narrow(d, bits, 1.0)) return d;
  }
}

template class RootDirection<RootVector<Dyadic>>;
template class RootDirection<NestedRootVector<Dyadic>>;

}  // namespace fathom::lens
