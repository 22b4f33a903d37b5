#include "fathom/lens/root_direction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

}  // namespace

std::optional<RootFormula<Dyadic>> root_formula(const Lens& lens) {
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
    default:
      return std::nullopt;
  }
}

RootProfile::RootProfile(const RootFormula<Dyadic>& formula)
    : formula_(formula.in([](const Dyadic& x) { return enclose(x).lower; })),
      end_(formula_.under < 0 ? 1 / std::sqrt(-formula_.under)
                              : std::numeric_limits<double>::infinity()) {}

double RootProfile::angle_at(double radius) const {
  const RootVector<double> d = formula_.at({radius, 0.0, 1.0});
  const double root = std::sqrt(std::max(d.s, 0.0));
  return std::atan2(d.a[0] + d.b[0] * root, d.a[2] + d.b[2] * root);
}

std::optional<double> RootProfile::radius_at(double angle, double farthest) const {
  double inner = 0, outer = std::min(end_, farthest);
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

/// The bits of the arithmetic of a box, and of what the sums of the formula may lose.
constexpr long bits_of_box = 72, spare_bits = 16;

std::array<DyadicInterval, 3> enclose_in_bits(const RootVector<Dyadic>& d, long bits) {
  const BigInterval root = sqrt(BigInterval(d.s, bits));
  const auto component = [&](std::size_t k) {
    return (BigInterval(d.a[k], bits) + BigInterval(d.b[k], bits) * root).ends();
  };
  return {component(0), component(1), component(2)};
}

Dyadic size_of(const DyadicInterval& x) {
  return std::max(abs(x.low), abs(x.high));
}

/// Of the greatest component.
RootVector<Dyadic> scaled_to_about_one(RootVector<Dyadic> d) {
  const auto [x, y, z] = enclose_in_bits(d, bits_of_box);
  const long top = std::max({size_of(x), size_of(y), size_of(z)}).top();
  for (std::size_t k = 0; k < 3; ++k) {
    d.a[k] = d.a[k].scaled(-top);
    d.b[k] = d.b[k].scaled(-top);
  }
  return d;
}

/// The sign of p + q·√s, s > 0.
Sign sign_with_root(const Dyadic& p, const Dyadic& q, const Dyadic& s) {
  if (p.sign() == q.sign() || q.is_zero()) return p.sign();
  if (p.is_zero()) return q.sign();
  const int greater = compare(p * p, q * q * s);
  if (greater == 0) return Sign::zero;
  return greater > 0 ? p.sign() : q.sign();
}

}  // namespace

RootDirection::RootDirection(RootVector<Dyadic> d) : d_(scaled_to_about_one(std::move(d))) {
  const auto [x, y, z] = enclosure(bits_of_box);
  box_ = {enclose(x), enclose(y), enclose(z)};
}

Sign RootDirection::sign_of(const ExactVector3& form) const {
  return sign_with_root(dot(form, d_.a), dot(form, d_.b), d_.s);
}

// F(a + b·√s) = F(a) + F(b)·s + (F(a + b) − F(a) − F(b))·√s.
Sign RootDirection::sign_of(const QuadraticForm& form) const {
  const Dyadic of_a = form.at(d_.a), of_b = form.at(d_.b);
  const Dyadic of_sum = form.at({d_.a[0] + d_.b[0], d_.a[1] + d_.b[1], d_.a[2] + d_.b[2]});
  return sign_with_root(of_a + of_b * d_.s, of_sum - of_a - of_b, d_.s);
}

std::array<DyadicInterval, 3> RootDirection::enclosure(long bits) const {
  for (long precision = bits + spare_bits;; precision *= 2) {
    auto d = enclose_in_bits(d_, precision);
    const Dyadic aside = std::max(size_of(d[0]), size_of(d[1])).scaled(-bits);
    const auto is_within = [&d](std::size_t k, const Dyadic& width) {
      return d[k].high - d[k].low <= width;
    };
    if (is_within(0, aside) && is_within(1, aside) && is_within(2, Dyadic(1.0).scaled(-bits)))
      return d;
  }
}

std::optional<DirectionWords> RootDirection::words() const {
  constexpr long bits = 90;
  return words_within(enclosure(bits));
}

}  // namespace fathom::lens
