#include "fathom/lens/angle_direction.h"

#include <utility>

#include "fathom/numeric/big_interval.h"

namespace fathom::lens {
namespace {

/// The bits of the first attempt at a sign, of the arithmetic of the box, and of what the sums of a
/// formula may lose.
constexpr long bits_of_sign = 128, bits_of_box = 72, bits_to_lose = 16;

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

bool is_zero(const AngleDirection::PlaneDirection& m, const ExactVector3& form) {
  return form[2].is_zero() && plane_sign(m, form) == Sign::zero;
}

bool is_zero(const AngleDirection::PlaneDirection& m, const QuadraticForm& form) {
  const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
  const QuadraticForm squares{{xx, yy, Dyadic(0.0), xy, Dyadic(0.0), Dyadic(0.0)}};
  return zz.is_zero() && plane_sign(m, ExactVector3{xz, yz, Dyadic(0.0)}) == Sign::zero &&
         plane_sign(m, squares) == Sign::zero;
}

template <class Form>
Sign sign_at(const AngleDirection::PlaneDirection& m, const Form& form) {
  for (long bits = bits_of_sign;; bits *= 2) {
    const Sign sign = Lifted(enclosure_of(m, bits), bits + bits_to_lose).at(form).sign();
    if (sign != Sign::zero) return sign;
    if (bits == bits_of_sign && is_zero(m, form)) return Sign::zero;
  }
}

std::array<Interval, 3> lifted_box(const std::array<Interval, 3>& m) {
  const auto exact = [](const Interval& x) { return DyadicInterval{x.lower, x.upper}; };
  const auto d = Lifted({exact(m[0]), exact(m[1]), exact(m[2])}, bits_of_box).direction();
  return {enclose(d[0].ends()), enclose(d[1].ends()), enclose(d[2].ends())};
}

}  // namespace

AngleDirection::AngleDirection(PlaneDirection m)
    : m_(std::move(m)), box_(lifted_box(std::visit([](const auto& d) { return d.box(); }, m_))) {}

Sign AngleDirection::sign_of(const ExactVector3& form) const {
  if (form[2].is_zero()) return plane_sign(m_, form);
  return sign_at(m_, form);
}

Sign AngleDirection::sign_of(const QuadraticForm& form) const {
  return sign_at(m_, form);
}

std::array<DyadicInterval, 3> AngleDirection::enclosure(long bits) const {
  const auto [x, y, z] =
      Lifted(enclosure_of(m_, bits + bits_to_lose), bits + bits_to_lose).direction();
  return {x.ends(), y.ends(), z.ends()};
}

}  // namespace fathom::lens
