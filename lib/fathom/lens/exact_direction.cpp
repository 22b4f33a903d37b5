#include "fathom/lens/exact_direction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "fathom/lens/elimination.h"
#include "fathom/lens/form_values.h"
#include "fathom/numeric/big_interval.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {

RationalDirection::RationalDirection(ExactVector3 vector, Dyadic scale)
    : vector_(std::move(vector)), scale_(std::move(scale)) {
  const Interval of_scale = enclose(scale_);
  for (std::size_t i = 0; i < 3; ++i) box_[i] = quotient(enclose(vector_[i]), of_scale);
}

// MPFR's least precision is 1 bit; 4 more make up for the roundings.
std::array<DyadicInterval, 3> RationalDirection::enclosure(long bits) const {
  const long precision = bits + 4;
  const BigInterval scale(scale_, precision);
  const auto component = [&](std::size_t i) {
    return (BigInterval(vector_[i], precision) / scale).ends();
  };
  return {component(0), component(1), component(2)};
}

namespace {

/// Of preimages under a stage: the bits of a box that binary64 did not find, and those that sums of
/// polynomials may lose.
constexpr long box_bits = 56, spare_bits = 64;

BigInterval number(const Dyadic& x, long bits) {
  return {x, bits};
}

/// The conversion to intervals of so many bits.
auto to_bits(long bits) {
  return [bits](const Dyadic& x) { return number(x, bits); };
}

/// F and the direction of one point, in intervals of so many bits.
class EnclosedElimination {
 public:
  EnclosedElimination(const PolynomialStage& stage, const DistortedPoint& y, long bits)
      : bits_(bits), numbers_(stage.exact.in(to_bits(bits))), y_(y.in(to_bits(bits))) {}

  [[nodiscard]] Elimination<BigInterval> at(const DyadicInterval& q) const {
    return eliminate(numbers_, y_, BigInterval(q, bits_));
  }

 private:
  long bits_;
  StageNumbers<BigInterval> numbers_;
  HomogeneousPoint<BigInterval> y_;
};

Sign exact_sign_of_f(const PolynomialStage& stage, const DistortedPoint& y, const Dyadic& q) {
  return eliminate(stage.exact, y, q).f.sign();
}

/// How many bits the ends of an interval of positive numbers share, about.
long shared_bits(const DyadicInterval& x) {
  const Dyadic width = x.high - x.low;
  if (width.is_zero()) return std::numeric_limits<long>::max();
  return x.low.is_zero() ? 0 : std::max(x.low.top() - width.top(), 0L);
}

Dyadic rounded(const Dyadic& x, long bits) {
  return number(x, bits).ends().low;
}

/// Narrows an interval with one root of F by signs of F. Where the secant meets 0 within it, two
/// signs may double the bits that are known; otherwise it is halved.
class RootNarrowing {
 public:
  RootNarrowing(const PolynomialStage& stage, const DistortedPoint& y, DyadicInterval q)
      : stage_(stage), y_(y), q_(std::move(q)) {}

  DyadicInterval to(long bits) {
    for (long gain = std::max(shared_bits(q_), 1L); shared_bits(q_) < bits;) {
      const long before = shared_bits(q_), wanted = std::min(before + gain, bits + 1);
      use_secant(wanted);
      if (shared_bits(q_) >= wanted) {
        gain *= 2;
      } else {
        halve(before + 1);
        gain = std::max(gain / 2, 1L);
      }
    }
    return q_;
  }

 private:
  void use_secant(long wanted) {
    const long bits = 2 * wanted + spare_bits;
    const EnclosedElimination F(stage_, y_, bits);
    const BigInterval low = F.at({q_.low, q_.low}).f, high = F.at({q_.high, q_.high}).f;
    const BigInterval rise = high - low;
    if (rise.sign() != Sign::positive) return;
    const BigInterval width = number(q_.high - q_.low, bits);
    const Dyadic x = q_.low - (low * width / rise).centre();
    const Dyadic half = Dyadic(1.0).scaled(q_.low.top() - wanted - 2);
    narrow(F, rounded(x - half, wanted + spare_bits));
    narrow(F, rounded(x + half, wanted + spare_bits));
  }

  void halve(long wanted) {
    const long bits = 2 * wanted + spare_bits;
    narrow(EnclosedElimination(stage_, y_, bits),
           rounded((q_.low + q_.high).scaled(-1), wanted + spare_bits));
  }

  /// Puts x in the place of one end.
  void narrow(const EnclosedElimination& F, Dyadic x) {
    if (x <= q_.low || x >= q_.high) return;
    Sign sign = F.at({x, x}).f.sign();
    if (sign == Sign::zero) sign = exact_sign_of_f(stage_, y_, x);
    (sign == Sign::negative ? q_.low : q_.high) = std::move(x);
  }

  const PolynomialStage& stage_;
  const DistortedPoint& y_;
  DyadicInterval q_;
};

/// F and the polynomial h that has the sign of a form at its root, primitive.
struct Polynomials {
  ExactPolynomial f, h;
};

template <class Form>
Polynomials polynomials_of(const PolynomialStage& stage, const DistortedPoint& y,
                           const Form& form) {
  const auto constant = [](const Dyadic& x) { return ExactPolynomial(x); };
  const Elimination<ExactPolynomial> e =
      eliminate(as_polynomials(stage.exact), y.in(constant), ExactPolynomial::variable());
  return {primitive(e.f), primitive(form_at(converted(form, constant), e.direction))};
}

/// Narrows (0, limit] to an interval whose ends differ by the factor 2 at most. nullopt if F is
/// negative at the limit: there is no root.
std::optional<DyadicInterval> isolate_root(const PolynomialStage& stage, const DistortedPoint& y) {
  const auto is_beyond = [&](const Dyadic& q) {
    return exact_sign_of_f(stage, y, q) != Sign::negative;
  };
  Dyadic high = stage.limit.value_or(1.0);
  if (!stage.limit) {
    const ExactPolynomial f = polynomials_of(stage, y, ExactVector3{}).f;
    if (f.sign_at_infinity() == Sign::negative) return std::nullopt;
    while (!is_beyond(high)) high = high.scaled(1);
  } else if (!is_beyond(high)) {
    return std::nullopt;
  }
  while (is_beyond(high.scaled(-1))) high = high.scaled(-1);
  return DyadicInterval{high.scaled(-1), high};
}

BigInterval value_of(const ExactPolynomial& p, const DyadicInterval& q, long bits) {
  std::vector<BigInterval> coefficients;
  for (const Dyadic& c : p.coefficients()) coefficients.push_back(number(c, bits));
  return horner(coefficients, BigInterval(q, bits));
}

/// Whether all numbers of an interval are smaller than 2^−bits.
bool is_below(const BigInterval& x, long bits) {
  const DyadicInterval ends = x.ends();
  const Dyadic bound = Dyadic(1.0).scaled(-bits);
  return abs(ends.low) < bound && abs(ends.high) < bound;
}

}  // namespace

PolynomialDirection::PolynomialDirection(const PolynomialStage& stage, const DistortedPoint& y,
                                         DyadicInterval q, const std::array<Interval, 3>& box)
    : stage_(&stage), y_(y), q_(std::move(q)), box_(box) {}

std::optional<PolynomialDirection> PolynomialDirection::find(const PolynomialStage& stage,
                                                             const DistortedPoint& y) {
  const RootEstimate estimate = estimate_root(stage, y);
  if (estimate.existence == Existence::no) return std::nullopt;
  if (estimate.existence == Existence::yes)
    return PolynomialDirection(stage, y, {estimate.low, estimate.high}, estimate.box);
  std::optional<DyadicInterval> q = isolate_root(stage, y);
  if (!q) return std::nullopt;
  PolynomialDirection direction(stage, y, std::move(*q), {});
  const std::array<DyadicInterval, 3> d = direction.enclosure(box_bits);
  for (std::size_t i = 0; i < 3; ++i) direction.box_[i] = enclose(d[i]);
  return direction;
}

// The third component is positive at the root: intervals that are narrow enough show it. They lose
// some bits in the sums, so there is no end before the components have as many as asked for.
std::array<DyadicInterval, 3> PolynomialDirection::enclosure(long bits) const {
  DyadicInterval q = q_;
  for (long precision = bits + spare_bits;; precision *= 2) {
    q = RootNarrowing(*stage_, y_, q).to(precision);
    const auto [x, y, z] = EnclosedElimination(*stage_, y_, precision + spare_bits).at(q).direction;
    if (z.sign() != Sign::positive) continue;
    const DyadicInterval mx = (x / z).ends(), my = (y / z).ends();
    const Dyadic size = std::max({abs(mx.low), abs(mx.high), abs(my.low), abs(my.high)});
    const Dyadic most = size.scaled(-bits);
    if (mx.high - mx.low <= most && my.high - my.low <= most)
      return {mx, my, DyadicInterval{1.0, 1.0}};
  }
}

std::optional<DirectionWords> PolynomialDirection::words() const {
  return words_of_preimage(*stage_, y_, {enclose(q_.low).upper, enclose(q_.high).lower});
}

template <class Form>
Sign PolynomialDirection::sign_of_form(const Form& form) const {
  DyadicInterval q = RootNarrowing(*stage_, y_, q_).to(first_bits);
  const auto enclosed = converted(form, to_bits(first_bits));
  const EnclosedElimination elimination(*stage_, y_, first_bits + spare_bits);
  const Sign sign = form_at(enclosed, elimination.at(q).direction).sign();
  if (sign != Sign::zero) return sign;

  const auto [f, h] = polynomials_of(*stage_, y_, form);
  if (h.is_zero()) return Sign::zero;
  const long bound = zero_bound_bits(f, h);
  for (long bits = 2 * first_bits;; bits *= 2) {
    q = RootNarrowing(*stage_, y_, q).to(bits);
    const BigInterval value = value_of(h, q, bits + spare_bits);
    if (value.sign() != Sign::zero) return value.sign();
    if (is_below(value, bound)) return Sign::zero;
  }
}

Sign PolynomialDirection::sign_of(const ExactVector3& form) const {
  return sign_of_form(form);
}

Sign PolynomialDirection::sign_of(const QuadraticForm& form) const {
  return sign_of_form(form.coefficients);
}

namespace {

std::array<DyadicInterval, 3> enclosure_of(const AngleDirection::PlaneDirection& m, long bits) {
  return std::visit([bits](const auto& d) { return d.enclosure(bits); }, m);
}

template <class Form>
Sign plane_sign(const AngleDirection::PlaneDirection& m, const Form& form) {
  return std::visit([&form](const auto& d) { return d.sign_of(form); }, m);
}

/// m, sin θ/θ and cos θ in intervals of so many bits.
struct Lifted {
  Lifted(const std::array<DyadicInterval, 3>& m, long the_bits)
      : bits(the_bits),
        x(m[0], bits),
        y(m[1], bits),
        angle(sqrt(square(x) + square(y))),
        sine_over_angle(sinc(angle)),
        cosine(cos(angle)) {}

  [[nodiscard]] BigInterval number(const Dyadic& value) const { return {value, bits}; }
  [[nodiscard]] std::array<BigInterval, 3> direction() const {
    return {x * sine_over_angle, y * sine_over_angle, cosine};
  }

  [[nodiscard]] BigInterval at(const ExactVector3& form) const {
    const BigInterval aside = number(form[0]) * x + number(form[1]) * y;
    return aside * sine_over_angle + number(form[2]) * cosine;
  }
  [[nodiscard]] BigInterval at(const QuadraticForm& form) const {
    const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
    const BigInterval squares =
        number(xx) * square(x) + number(yy) * square(y) + number(xy) * (x * y);
    const BigInterval mixed = number(xz) * x + number(yz) * y;
    return (squares * sine_over_angle + mixed * cosine) * sine_over_angle +
           number(zz) * square(cosine);
  }

  long bits;
  BigInterval x, y, angle, sine_over_angle, cosine;
};

/// Whether all coefficients of the polynomial in tan θ are 0.
bool is_zero(const AngleDirection::PlaneDirection& m, const QuadraticForm& form) {
  const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
  const QuadraticForm squares{{xx, yy, Dyadic(0.0), xy, Dyadic(0.0), Dyadic(0.0)}};
  return zz.is_zero() && plane_sign(m, ExactVector3{xz, yz, Dyadic(0.0)}) == Sign::zero &&
         plane_sign(m, squares) == Sign::zero;
}

/// Sign::zero if so many bits do not settle it.
template <class Form>
Sign sign_in_bits(const AngleDirection::PlaneDirection& m, const Form& form, long bits) {
  return Lifted(enclosure_of(m, bits), bits + bits_to_lose).at(form).sign();
}

/// The sign of a form that is not 0.
template <class Form>
Sign sign_of_nonzero(const AngleDirection::PlaneDirection& m, const Form& form, long bits) {
  Sign sign = Sign::zero;
  for (; sign == Sign::zero; bits *= 2) sign = sign_in_bits(m, form, bits);
  return sign;
}

/// The box of m; its ends are infinite where numbers overflow in binary64, unlike an enclosure's.
std::array<DyadicInterval, 3> finite_box(const AngleDirection::PlaneDirection& m) {
  const std::array<Interval, 3> box = std::visit([](const auto& d) { return d.box(); }, m);
  const auto is_finite = [](const Interval& x) {
    return std::isfinite(x.lower) && std::isfinite(x.upper);
  };
  if (!std::ranges::all_of(box, is_finite)) return enclosure_of(m, bits_of_box);
  const auto exact = [](const Interval& x) { return DyadicInterval{x.lower, x.upper}; };
  return {exact(box[0]), exact(box[1]), exact(box[2])};
}

std::array<Interval, 3> lifted_box(const AngleDirection::PlaneDirection& m) {
  const auto d = Lifted(finite_box(m), bits_of_box).direction();
  return {enclose(d[0].ends()), enclose(d[1].ends()), enclose(d[2].ends())};
}

}  // namespace

AngleDirection::AngleDirection(PlaneDirection m) : m_(std::move(m)), box_(lifted_box(m_)) {}

Sign AngleDirection::sign_of(const ExactVector3& form) const {
  if (form[2].is_zero()) return plane_sign(m_, form);
  return sign_of_nonzero(m_, form, first_bits);
}

Sign AngleDirection::sign_of(const QuadraticForm& form) const {
  const Sign sign = sign_in_bits(m_, form, first_bits);
  if (sign != Sign::zero) return sign;
  return is_zero(m_, form) ? Sign::zero : sign_of_nonzero(m_, form, 2 * first_bits);
}

std::array<DyadicInterval, 3> AngleDirection::enclosure(long bits) const {
  const auto [x, y, z] =
      Lifted(enclosure_of(m_, bits + bits_to_lose), bits + bits_to_lose).direction();
  return {x.ends(), y.ends(), z.ends()};
}

ExactDirection::ExactDirection(RationalDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(PolynomialDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(AngleDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(OneRootDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(NestedRootDirection direction) : direction_(std::move(direction)) {}

ExactDirection::ExactDirection(TurnDirection direction) : direction_(std::move(direction)) {}

const std::array<Interval, 3>& ExactDirection::box() const {
  return std::visit(
      [](const auto& d) -> const auto& { return d.box(); }, direction_);
}

Sign ExactDirection::sign_of(const ExactVector3& form) const {
  const StandardArithmetic standard;
  return std::visit([&](const auto& d) { return d.sign_of(form); }, direction_);
}

Sign ExactDirection::sign_of(const QuadraticForm& form) const {
  const StandardArithmetic standard;
  return std::visit([&](const auto& d) { return d.sign_of(form); }, direction_);
}

std::array<DyadicInterval, 3> ExactDirection::enclosure(long bits) const {
  const StandardArithmetic standard;
  return std::visit([bits](const auto& d) { return d.enclosure(bits); }, direction_);
}

std::optional<DirectionWords> ExactDirection::words() const {
  const StandardArithmetic standard;
  constexpr long bits = 90;
  return std::visit(
      [](const auto& d) -> std::optional<DirectionWords> {
        if constexpr (requires { d.words(); })
          return d.words();
        else
          return words_within(d.enclosure(bits));
      },
      direction_);
}

const ExactVector3* ExactDirection::rational() const {
  const auto* const rational = std::get_if<RationalDirection>(&direction_);
  return rational == nullptr ? nullptr : &rational->vector();
}

}  // namespace fathom::lens
