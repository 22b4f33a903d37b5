#include "fathom/lens/preimages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/numeric/big_interval.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

// With y = (a, b)/c: d·c² = (a·c, b·c, c² + k·(a² + b²)), and there is a ray where k·r² < 1.
std::optional<RationalDirection> divide(const DistortedPoint& y, const Dyadic& k) {
  const Dyadic c_squared = y.c * y.c, term = k * (y.a * y.a + y.b * y.b);
  if (!(term < c_squared)) return std::nullopt;
  return RationalDirection({y.a * y.c, y.b * y.c, c_squared + term}, c_squared);
}

/// Whether every angle is at most `radius`: the next number after π's nearest is above π.
bool is_beyond_every_angle(double radius) {
  return radius > std::numbers::pi;
}

/// Whether the angle between d and the z axis is at most `radius` > 0: the sign of z −
/// |d|·cos(radius). It is never 0. Of an algebraic d: the cosine of a rational number other than 0
/// is transcendental. Of FOV it would be 0 if sin α·cos β·cos(radius) = 2·cos α·sin β·sin(radius)
/// with α = ωr and β = ω/2. The exponent i(α + β + radius) occurs once on each side, with the
/// factors 1/8i and −¼: they differ (Lindemann, Weierstrass).
template <class Direction>
bool is_within_angle(const Direction& d, double radius) {
  if (is_beyond_every_angle(radius)) return true;
  for (long bits = 128;; bits *= 2) {
    const auto [dx, dy, dz] = d.enclosure(bits);
    const BigInterval x(dx, bits), y(dy, bits), z(dz, bits);
    const BigInterval length = sqrt(square(x) + square(y) + square(z));
    const Sign sign = (z - length * cos(BigInterval(radius, bits))).sign();
    if (sign != Sign::zero) return sign == Sign::positive;
  }
}

/// The direction, if it lies within `radius` of the axis.
template <class Direction>
std::optional<ExactDirection> kept_within(double radius, Direction direction) {
  if (!is_within_angle(direction, radius)) return std::nullopt;
  return ExactDirection(std::move(direction));
}

/// Whether |m|² ≤ limit.
bool is_within(const std::optional<Dyadic>& limit, const DistortedPoint& m) {
  return !limit || m.a * m.a + m.b * m.b <= *limit * (m.c * m.c);
}

/// Whether d is a positive multiple of (x_d, y_d, 1) everywhere.
bool is_straight(const AnyRootFormula<Dyadic>& formula) {
  const auto* const one_root = std::get_if<RootFormula<Dyadic>>(&formula);
  return one_root != nullptr && one_root->aside_root.is_zero() && one_root->ahead_root.is_zero();
}

PolynomialStage prepared_stage(const Lens& lens) {
  return PolynomialStage(has_stage(lens.model) || has_stage_before_root(lens) ? lens : Lens());
}

}  // namespace

double division_term(const Lens& lens) {
  const StandardArithmetic standard;
  return lens.model == LensModel::fisheye_stereographic ? -0.25 : lens.distortion[0];
}

ExactVector3 scaled_to_one(ExactVector3 direction) {
  const StandardArithmetic standard;
  std::optional<long> top;
  for (const Dyadic& component : direction)
    if (!component.is_zero()) top = std::max(top.value_or(component.top()), component.top());
  for (Dyadic& component : direction) component = component.scaled(-*top);
  return direction;
}

Preimages::Preimages(const Projection& projection, const Lens& lens)
    : plane_(projection),
      lens_(lens),
      tilt_(Tilt::of(lens)),
      stage_(prepared_stage(lens)),
      roots_(root_formula(lens)) {
  const StandardArithmetic standard;
  if (lens.model == LensModel::ftheta) angle_.emplace(lens);
}

std::optional<ExactDirection> Preimages::of(const Dyadic& u, const Dyadic& v) const {
  const StandardArithmetic standard;
  if (lens_.directions) {
    throw UsageError("the lens TABLE: has directions of the centres of its pixels only");
  }
  if (has_stage_before_root(lens_)) return by_root_before_stage(u, v);
  if (roots_) return by_root(plane_.at(u, v));
  if (is_panorama(lens_.model)) return by_turns(plane_.at(u, v));
  if (angle_) return by_angle(plane_.at(u, v));
  if (lens_.model == LensModel::fov) return by_field_of_view(plane_.at(u, v));
  if (!has_stage(lens_.model)) {
    std::optional<RationalDirection> d = divide(plane_.at(u, v), division_term(lens_));
    if (!d || !is_within_angle(*d, lens_.max_radius)) return std::nullopt;
    return ExactDirection(std::move(*d));
  }
  std::optional<PlaneDirection> m = find_before_stage(u, v);
  if (!m) return std::nullopt;
  return lifted(std::move(*m));
}

// The axis is rational, and so is every direction of a formula that bends nothing.
std::optional<ExactDirection> Preimages::by_root(const DistortedPoint& y) const {
  const bool is_on_axis = y.a.is_zero() && y.b.is_zero();
  if (is_on_axis || is_straight(*roots_))
    return kept_within(lens_.max_radius, RationalDirection({y.a, y.b, y.c}, y.c));
  return std::visit(
      [&](const auto& formula) -> std::optional<ExactDirection> {
        auto d = formula.at(y);
        if (d.s.sign() != Sign::positive) return std::nullopt;
        return kept_within(lens_.max_radius, RootDirection(std::move(d)));
      },
      *roots_);
}

// The axis is rational.
std::optional<ExactDirection> Preimages::by_root_before_stage(const Dyadic& u,
                                                              const Dyadic& v) const {
  std::optional<PlaneDirection> m = find_before_stage(u, v);
  if (!m) return std::nullopt;
  if (auto* const axis = std::get_if<RationalDirection>(&*m))
    return kept_within(lens_.max_radius, std::move(*axis));
  return kept_within(lens_.max_radius,
                     BentRootDirection(std::get<PolynomialDirection>(std::move(*m)),
                                       std::get<RootFormula<Dyadic>>(*roots_)));
}

namespace {

/// Whether ωr < π/2 with r = |y|: never equal, because ωr is algebraic.
bool is_before_right_angle(const DistortedPoint& y, double omega) {
  for (long bits = 128;; bits *= 2) {
    const auto number = [bits](const Dyadic& x) { return BigInterval(x, bits); };
    const BigInterval r = sqrt(square(number(y.a)) + square(number(y.b))) / number(y.c);
    const Sign sign = (BigInterval::pi(bits) - r * number(2 * omega)).sign();
    if (sign != Sign::zero) return sign == Sign::positive;
  }
}

}  // namespace

// Where r = ½, d is 2·sin(ω/2)·(x_d, y_d, 1).
std::optional<ExactDirection> Preimages::by_field_of_view(const DistortedPoint& y) const {
  const double omega = std::abs(lens_.distortion[0]);
  const Dyadic square = y.a * y.a + y.b * y.b;
  RationalDirection straight({y.a, y.b, y.c}, y.c);
  if (omega == 0 || square.is_zero() || square.scaled(2) == y.c * y.c)
    return kept_within(lens_.max_radius, std::move(straight));
  if (!is_before_right_angle(y, omega)) return std::nullopt;
  return kept_within(lens_.max_radius, AngleDirection(std::move(straight), omega));
}

// Where θ = 0 the ray is the axis. θ is algebraic and not π, and it may be max_radius.
std::optional<ExactDirection> Preimages::by_angle(const DistortedPoint& y) const {
  const Dyadic square = y.a * y.a + y.b * y.b, end = Dyadic(angle_->end()) * y.c;
  const RationalDirection axis({Dyadic(0.0), Dyadic(0.0), Dyadic(1.0)});
  if (square.is_zero())
    return angle_->coefficients()[0].is_zero() ? std::optional(ExactDirection(axis)) : std::nullopt;
  if (square > end * end) return std::nullopt;
  if (!is_beyond_every_angle(lens_.max_radius)) {
    if (angle_->compare(y, lens_.max_radius) == Sign::positive) return std::nullopt;
    if (angle_->compare(y, -lens_.max_radius) == Sign::negative) return std::nullopt;
  }
  const Sign sign = angle_->compare(y, 0.0);
  if (sign == Sign::zero) return ExactDirection(axis);
  // (m·sin θ/r, cos θ) is (−m·sin(−θ)/r, cos(−θ)).
  const bool is_across = sign == Sign::negative;
  std::array<Dyadic, 6> polynomial = angle_->coefficients();
  if (is_across)
    for (Dyadic& p : polynomial) p = -p;
  RationalDirection m({is_across ? -y.a : y.a, is_across ? -y.b : y.b, y.c}, y.c);
  return ExactDirection(AngleDirection(std::move(m), polynomial));
}

// At a pole, ½ of half a turn, the cosine is 0: d = (0, ±1, 0).
std::optional<ExactDirection> Preimages::by_turns(const DistortedPoint& sample) const {
  if (lens_.model == LensModel::cylindrical)
    return kept_within(lens_.max_radius, TurnDirection::cylindrical(sample));
  const int beyond_pole = compare(abs(sample.b).scaled(1), sample.c);
  if (beyond_pole > 0) return std::nullopt;
  if (beyond_pole < 0) return kept_within(lens_.max_radius, TurnDirection::equirectangular(sample));
  const double down = sample.b.sign() == Sign::positive ? 1 : -1;
  return kept_within(lens_.max_radius, RationalDirection({0.0, down, 0.0}));
}

std::optional<ExactDirection> Preimages::before_stage(const Dyadic& u, const Dyadic& v) const {
  const StandardArithmetic standard;
  const std::optional<PlaneDirection> m = find_before_stage(u, v);
  if (!m) return std::nullopt;
  return std::visit([](const auto& d) { return ExactDirection(d); }, *m);
}

std::optional<PlaneDirection> Preimages::find_before_stage(const Dyadic& u, const Dyadic& v) const {
  std::optional<DistortedPoint> y = plane_.at(u, v);
  if (tilt_) y = tilt_->undone(*y);
  if (!y) return std::nullopt;
  const bool is_on_axis = y->a.is_zero() && y->b.is_zero();
  if (is_on_axis || is_identity(stage_.numbers)) {
    if (!is_within(stage_.limit, *y)) return std::nullopt;
    return RationalDirection({y->a, y->b, y->c}, y->c);
  }
  std::optional<PolynomialDirection> d = PolynomialDirection::find(stage_, *y);
  if (!d) return std::nullopt;
  return std::move(*d);
}

ExactDirection Preimages::lifted(PlaneDirection m) const {
  const auto* const rational = std::get_if<RationalDirection>(&m);
  if (is_plane(lens_.model))
    return std::visit([](auto& d) { return ExactDirection(std::move(d)); }, m);
  const bool is_axis =
      rational != nullptr && rational->vector()[0].is_zero() && rational->vector()[1].is_zero();
  if (is_axis) return ExactDirection(RationalDirection({Dyadic(0.0), Dyadic(0.0), Dyadic(1.0)}));
  return ExactDirection(AngleDirection(std::move(m)));
}

std::optional<ExactDirection> Preimages::of_pixel(std::uint32_t column, std::uint32_t row) const {
  const StandardArithmetic standard;
  if (!lens_.directions) return of(column + 0.5, row + 0.5);
  const auto d = lens_.directions->at(column, row);
  if (!d) return std::nullopt;
  RationalDirection direction(scaled_to_one({(*d)[0], (*d)[1], (*d)[2]}));
  if (!is_within_angle(direction, lens_.max_radius)) return std::nullopt;
  return ExactDirection(std::move(direction));
}

std::optional<Interval> Preimages::cosine_of_end() const {
  const StandardArithmetic standard;
  if (has_stage(lens_.model) || is_beyond_every_angle(lens_.max_radius)) return std::nullopt;
  constexpr long bits = 64;
  return enclose(cos(BigInterval(Dyadic(lens_.max_radius), bits)).ends());
}

// K⁻¹ and the tilt are linear: three points show the matrix of both.
std::array<ExactVector3, 3> Preimages::plane_map() const {
  const StandardArithmetic standard;
  const auto at = [&](double u, double v) {
    const DistortedPoint y = plane_.at(u, v);
    const ExactVector3 vector{y.a, y.b, y.c};
    return tilt_ ? tilt_->inverse_times(vector) : vector;
  };
  const ExactVector3 origin = at(0, 0), along_u = at(1, 0), along_v = at(0, 1);
  std::array<ExactVector3, 3> rows;
  for (std::size_t i = 0; i < 3; ++i)
    rows[i] = {along_u[i] - origin[i], along_v[i] - origin[i], origin[i]};
  return rows;
}

}  // namespace fathom::lens
