#include "fathom/lens/plane_direction.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "fathom/lens/elimination.h"
#include "fathom/lens/form_values.h"
#include "fathom/numeric/big_interval.h"

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

using ExactStage = StageNumbers<Dyadic>;

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
  EnclosedElimination(const ExactStage& stage, const DistortedPoint& y, long bits)
      : bits_(bits), numbers_(stage.in(to_bits(bits))), y_(y.in(to_bits(bits))) {}

  [[nodiscard]] Elimination<BigInterval> at(const DyadicInterval& q) const {
    return eliminate(numbers_, y_, BigInterval(q, bits_));
  }

 private:
  long bits_;
  StageNumbers<BigInterval> numbers_;
  HomogeneousPoint<BigInterval> y_;
};

Sign exact_sign_of_f(const ExactStage& stage, const DistortedPoint& y, const Dyadic& q) {
  return eliminate(stage, y, q).f.sign();
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
  RootNarrowing(const ExactStage& stage, const DistortedPoint& y, DyadicInterval q)
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

  const ExactStage& stage_;
  const DistortedPoint& y_;
  DyadicInterval q_;
};

/// F and the polynomial h that has the sign of a form at its root, primitive.
struct Polynomials {
  ExactPolynomial f, h;
};

Elimination<ExactPolynomial> eliminate_exactly(const ExactStage& stage, const DistortedPoint& y) {
  const auto constant = [](const Dyadic& x) { return ExactPolynomial(x); };
  return eliminate(as_polynomials(stage), y.in(constant), ExactPolynomial::variable());
}

Polynomials polynomials_of(const ExactStage& stage, const DistortedPoint& y,
                           const DirectionPolynomial& polynomial) {
  const Elimination<ExactPolynomial> e = eliminate_exactly(stage, y);
  return {primitive(e.f), primitive(polynomial.at(e.direction))};
}

/// Narrows (0, limit] to an interval whose ends differ by the factor 2 at most. nullopt if F is
/// negative at the limit: there is no root.
std::optional<DyadicInterval> isolate_root(const PolynomialStage& stage, const DistortedPoint& y) {
  const auto is_beyond = [&](const Dyadic& q) {
    return exact_sign_of_f(stage.exact, y, q) != Sign::negative;
  };
  Dyadic high = stage.limit.value_or(1.0);
  if (!stage.limit) {
    const ExactPolynomial f = eliminate_exactly(stage.exact, y).f;
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
    q = RootNarrowing(stage_->exact, y_, q).to(precision);
    const auto [x, y, z] =
        EnclosedElimination(stage_->exact, y_, precision + spare_bits).at(q).direction;
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

namespace {

bool has_no_z(const ExactVector3& form) {
  return form[2].is_zero();
}
bool has_no_z(const std::array<Dyadic, 6>& form) {
  return form[2].is_zero() && form[4].is_zero() && form[5].is_zero();
}

/// A linear or quadratic form.
template <class Form>
class FormPolynomial : public DirectionPolynomial {
 public:
  explicit FormPolynomial(const Form& form) : form_(form) {}

  [[nodiscard]] BigInterval at(const std::array<BigInterval, 3>& d, long bits) const override {
    return form_at(converted(form_, to_bits(bits)), d);
  }
  [[nodiscard]] ExactPolynomial at(const std::array<ExactPolynomial, 3>& d) const override {
    return form_at(converted(form_, [](const Dyadic& x) { return ExactPolynomial(x); }), d);
  }

 private:
  const Form& form_;
};

/// The sign of a polynomial at the direction whose root lies in q.
Sign sign_at_root(const ExactStage& stage, const DistortedPoint& y, DyadicInterval q,
                  const DirectionPolynomial& polynomial) {
  q = RootNarrowing(stage, y, q).to(first_bits);
  const EnclosedElimination elimination(stage, y, first_bits + spare_bits);
  const Sign sign = polynomial.at(elimination.at(q).direction, first_bits + spare_bits).sign();
  if (sign != Sign::zero) return sign;

  const auto [f, h] = polynomials_of(stage, y, polynomial);
  if (h.is_zero()) return Sign::zero;
  const long bound = zero_bound_bits(f, h);
  for (long bits = 2 * first_bits;; bits *= 2) {
    q = RootNarrowing(stage, y, q).to(bits);
    const BigInterval value = value_of(h, q, bits + spare_bits);
    if (value.sign() != Sign::zero) return value.sign();
    if (is_below(value, bound)) return Sign::zero;
  }
}

}  // namespace

Sign PolynomialDirection::sign_of(const DirectionPolynomial& polynomial) const {
  return sign_at_root(stage_->exact, y_, q_, polynomial);
}

// A first stage moves m along its direction from 0: the point before the second stage has the signs
// of forms without z, and is the root of a polynomial of degree 8, not of more than 100.
template <class Form>
Sign PolynomialDirection::sign_of_form(const Form& form) const {
  const ExactStage& exact = stage_->exact;
  const FormPolynomial polynomial(form);
  if (!exact.is_double() || !has_no_z(form)) return sign_of(polynomial);
  const DyadicInterval image{image_of_circle(exact, q_.low), image_of_circle(exact, q_.high)};
  return sign_at_root(second_stage(exact), y_, image, polynomial);
}

Sign PolynomialDirection::sign_of(const ExactVector3& form) const {
  return sign_of_form(form);
}

Sign PolynomialDirection::sign_of(const QuadraticForm& form) const {
  return sign_of_form(form.coefficients);
}

}  // namespace fathom::lens
