#include "fathom/lens/angle_direction.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "fathom/lens/form_values.h"
#include "fathom/numeric/big_interval.h"

namespace fathom::lens {
namespace {

std::array<DyadicInterval, 3> enclosure_of(const PlaneDirection& m, long bits) {
  return std::visit([bits](const auto& d) { return d.enclosure(bits); }, m);
}

template <class Form>
Sign plane_sign(const PlaneDirection& m, const Form& form) {
  return std::visit([&form](const auto& d) { return d.sign_of(form); }, m);
}

/// t = tan(ω/2)/(ω/2)
BigInterval stretch_in_bits(double omega, long bits) {
  const BigInterval half(Dyadic(omega).scaled(-1), bits);
  return sinc(half) / cos(half);
}

/// m, sin θ/θ (of FTHETA sin θ/|m|) and t·cos θ in intervals of so many bits.
struct Lifted {
  Lifted(const std::array<DyadicInterval, 3>& m, const AngleFormula& formula, long the_bits)
      : bits(the_bits),
        x(m[0], bits),
        y(m[1], bits),
        radius(sqrt(square(x) + square(y))),
        angle(angle_of(formula)),
        aside(aside_of(formula)),
        ahead(ahead_of(formula)) {}

  [[nodiscard]] BigInterval number(const Dyadic& value) const { return {value, bits}; }
  [[nodiscard]] std::array<BigInterval, 3> direction() const {
    return {x * aside, y * aside, ahead};
  }

  [[nodiscard]] BigInterval at(const ExactVector3& form) const {
    return (number(form[0]) * x + number(form[1]) * y) * aside + number(form[2]) * ahead;
  }
  [[nodiscard]] BigInterval at(const QuadraticForm& form) const {
    const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
    const BigInterval squares =
        number(xx) * square(x) + number(yy) * square(y) + number(xy) * (x * y);
    const BigInterval mixed = number(xz) * x + number(yz) * y;
    return (squares * aside + mixed * ahead) * aside + number(zz) * square(ahead);
  }

  long bits;
  BigInterval x, y, radius, angle, aside, ahead;

 private:
  [[nodiscard]] BigInterval angle_of(const AngleFormula& formula) const {
    if (formula.omega) return radius * number(*formula.omega);
    if (formula.polynomial.empty()) return radius;
    std::vector<BigInterval> coefficients;
    for (const Dyadic& p : formula.polynomial) coefficients.push_back(number(p));
    return horner(coefficients, radius);
  }
  [[nodiscard]] BigInterval aside_of(const AngleFormula& formula) const {
    if (formula.polynomial.empty()) return sinc(angle);
    return sinc(angle) * angle / radius;
  }
  [[nodiscard]] BigInterval ahead_of(const AngleFormula& formula) const {
    const BigInterval cosine = cos(angle);
    return formula.omega ? cosine * stretch_in_bits(*formula.omega, bits) : cosine;
  }
};

/// Whether all coefficients of the polynomial in sin θ/θ and t·cos θ are 0.
bool is_zero(const PlaneDirection& m, const QuadraticForm& form) {
  const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
  const QuadraticForm squares{{xx, yy, Dyadic(0.0), xy, Dyadic(0.0), Dyadic(0.0)}};
  return zz.is_zero() && plane_sign(m, ExactVector3{xz, yz, Dyadic(0.0)}) == Sign::zero &&
         plane_sign(m, squares) == Sign::zero;
}

/// The box of m; its ends are infinite where numbers overflow in binary64, unlike an enclosure's.
std::array<DyadicInterval, 3> finite_box(const PlaneDirection& m) {
  const std::array<Interval, 3> box = std::visit([](const auto& d) { return d.box(); }, m);
  const auto is_finite = [](const Interval& x) {
    return std::isfinite(x.lower) && std::isfinite(x.upper);
  };
  if (!std::ranges::all_of(box, is_finite)) return enclosure_of(m, bits_of_box);
  const auto exact = [](const Interval& x) { return DyadicInterval{x.lower, x.upper}; };
  return {exact(box[0]), exact(box[1]), exact(box[2])};
}

std::array<Interval, 3> enclose_each(const std::array<DyadicInterval, 3>& d) {
  return {enclose(d[0]), enclose(d[1]), enclose(d[2])};
}

std::array<DyadicInterval, 3> ends_of(const std::array<BigInterval, 3>& d) {
  return {d[0].ends(), d[1].ends(), d[2].ends()};
}

}  // namespace

Interval stretch_of_field(double omega) {
  return enclose(stretch_in_bits(omega, bits_of_box).ends());
}

AngleDirection::AngleDirection(PlaneDirection m)
    : m_(std::move(m)),
      box_(enclose_each(ends_of(Lifted(finite_box(m_), formula_, bits_of_box).direction()))) {}

AngleDirection::AngleDirection(RationalDirection m, double omega)
    : m_(std::move(m)), formula_{.omega = omega}, box_(enclose_each(enclosure(bits_of_box))) {}

AngleDirection::AngleDirection(RationalDirection m, std::span<const Dyadic> polynomial)
    : m_(std::move(m)),
      formula_{.polynomial = {polynomial.begin(), polynomial.end()}},
      box_(enclose_each(enclosure(bits_of_box))) {}

template <class Form>
Sign AngleDirection::sign_in_bits(const Form& form, long bits) const {
  return Lifted(enclosure_of(m_, bits), formula_, bits + bits_to_lose).at(form).sign();
}

template <class Form>
Sign AngleDirection::sign_of_nonzero(const Form& form, long bits) const {
  Sign sign = Sign::zero;
  for (; sign == Sign::zero; bits *= 2) sign = sign_in_bits(form, bits);
  return sign;
}

Sign AngleDirection::sign_of(const ExactVector3& form) const {
  if (form[2].is_zero()) return plane_sign(m_, form);
  return sign_of_nonzero(form, first_bits);
}

Sign AngleDirection::sign_of(const QuadraticForm& form) const {
  const Sign sign = sign_in_bits(form, first_bits);
  if (sign != Sign::zero) return sign;
  return is_zero(m_, form) ? Sign::zero : sign_of_nonzero(form, 2 * first_bits);
}

std::array<DyadicInterval, 3> AngleDirection::enclosure(long bits) const {
  for (long precision = bits + bits_to_lose;; precision *= 2) {
    auto d = ends_of(Lifted(enclosure_of(m_, precision), formula_, precision).direction());
    if (is_narrow(d, bits, std::max({size_of(d[0]), size_of(d[1]), size_of(d[2])}))) return d;
  }
}

}  // namespace fathom::lens
