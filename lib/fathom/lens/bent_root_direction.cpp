#include "fathom/lens/bent_root_direction.h"

#include <algorithm>
#include <utility>

#include "fathom/lens/form_values.h"
#include "fathom/numeric/big_interval.h"

namespace fathom::lens {
namespace {

/// p + q·√s, over any arithmetic.
template <class T>
struct Value {
  T p, q;
};

template <class T>
Value<T> value_at(const std::array<T, 3>& form, const RootVector<T>& d) {
  return {form_at(form, d.a), form_at(form, d.b)};
}

// F(a + b·√s) = F(a) + F(b)·s + (F(a + b) − F(a) − F(b))·√s.
template <class T>
Value<T> value_at(const std::array<T, 6>& form, const RootVector<T>& d) {
  const T of_a = form_at(form, d.a), of_b = form_at(form, d.b);
  const std::array<T, 3> sum{d.a[0] + d.b[0], d.a[1] + d.b[1], d.a[2] + d.b[2]};
  return {of_a + of_b * d.s, form_at(form, sum) - of_a - of_b};
}

template <class T>
HomogeneousPoint<T> as_point(const std::array<T, 3>& d) {
  return {d[0], d[1], d[2]};
}

enum class Part { p, q, difference_of_squares };

/// A part of the value of a form, as a polynomial in (m, 1).
template <class Form>
class PartOfValue : public DirectionPolynomial {
 public:
  PartOfValue(Part part, const Form& form, const RootFormula<Dyadic>& formula)
      : part_(part), form_(form), formula_(formula) {}

  [[nodiscard]] BigInterval at(const std::array<BigInterval, 3>& d, long bits) const override {
    return part_at(d, [bits](const Dyadic& x) { return BigInterval(x, bits); });
  }
  [[nodiscard]] ExactPolynomial at(const std::array<ExactPolynomial, 3>& d) const override {
    return part_at(d, [](const Dyadic& x) { return ExactPolynomial(x); });
  }

 private:
  template <class T, class Convert>
  [[nodiscard]] T part_at(const std::array<T, 3>& m, const Convert& convert) const {
    const RootVector<T> d = formula_.in(convert).at(as_point(m));
    const auto [p, q] = value_at(converted(form_, convert), d);
    if (part_ == Part::p) return p;
    return part_ == Part::q ? q : p * p - q * q * d.s;
  }

  Part part_;
  const Form& form_;
  const RootFormula<Dyadic>& formula_;
};

RootVector<BigInterval> enclose_direction(const PolynomialDirection& m,
                                          const RootFormula<Dyadic>& formula, long bits) {
  const auto number = [bits](const auto& x) { return BigInterval(x, bits); };
  return formula.in(number).at(as_point(converted(m.enclosure(bits), number)));
}

}  // namespace

BentRootDirection::BentRootDirection(PolynomialDirection m, const RootFormula<Dyadic>& formula)
    : m_(std::move(m)), formula_(formula) {
  const auto [x, y, z] = enclosure(bits_of_box);
  box_ = {enclose(x), enclose(y), enclose(z)};
}

template <class Form>
Sign BentRootDirection::sign_of_form(const Form& form) const {
  const RootVector<BigInterval> d = enclose_direction(m_, formula_, first_bits);
  if (d.s.sign() == Sign::positive) {
    const auto number = [](const Dyadic& x) { return BigInterval(x, first_bits); };
    const Sign sign = form_at(converted(form, number), d.components()).sign();
    if (sign != Sign::zero) return sign;
  }
  const auto of = [&](Part part) { return m_.sign_of(PartOfValue(part, form, formula_)); };
  const Sign of_p = of(Part::p), of_q = of(Part::q);
  if (of_p == of_q || of_q == Sign::zero) return of_p;
  if (of_p == Sign::zero) return of_q;
  const Sign greater = of(Part::difference_of_squares);
  if (greater == Sign::zero) return Sign::zero;
  return greater == Sign::positive ? of_p : of_q;
}

Sign BentRootDirection::sign_of(const ExactVector3& form) const {
  return sign_of_form(form);
}

Sign BentRootDirection::sign_of(const QuadraticForm& form) const {
  return sign_of_form(form.coefficients);
}

std::array<DyadicInterval, 3> BentRootDirection::enclosure(long bits) const {
  for (long precision = bits + bits_to_lose;; precision *= 2) {
    const RootVector<BigInterval> vector = enclose_direction(m_, formula_, precision);
    if (vector.s.sign() != Sign::positive) continue;
    const auto [x, y, z] = vector.components();
    std::array<DyadicInterval, 3> d{x.ends(), y.ends(), z.ends()};
    if (is_narrow(d, bits, std::max({size_of(d[0]), size_of(d[1]), size_of(d[2])}))) return d;
  }
}

}  // namespace fathom::lens
