#include "fathom/depth_format/mapping.h"

#include "fathom/numeric/logarithm.h"

namespace fathom {
namespace {

Ratio quotient(const Ratio& a, const Ratio& b) {
  return {a.numerator * b.denominator, a.denominator * b.numerator};
}

const Ratio& one() {
  static const Ratio value = Dyadic(1.0);
  return value;
}

}  // namespace

Real stored_value(const DepthFormat& format, const Ratio& depth) {
  const auto& D = depth;
  const Ratio near = Dyadic(format.near);
  // Mappings that know far only as infinity may have a far that is not a number of this kind.
  const Ratio far = takes_infinite_far(format.mapping) ? Ratio() : Ratio(Dyadic(format.far));
  switch (format.mapping) {
    case Mapping::standard:
    case Mapping::opengl:
      return quotient(far * (D - near), D * (far - near));
    case Mapping::reversed:
      return quotient(near * (far - D), D * (far - near));
    case Mapping::infinite:
      return quotient(D - near, D);
    case Mapping::reversed_infinite:
      return quotient(near, D);
    case Mapping::linear:
      return quotient(D - near, far - near);
    case Mapping::w:
      return quotient(D, far);
    case Mapping::log: {
      const Ratio c = Dyadic(format.c);
      return quotient_of_logarithms(one() + c * D, one() + c * far);
    }
    case Mapping::log_ulrich:
      return quotient_of_logarithms(quotient(D, near), quotient(far, near));
  }
  return Ratio();
}

std::optional<Real> depth_of(const DepthFormat& format, const Ratio& value) {
  const auto& s = value;
  const Ratio near = Dyadic(format.near);
  const Ratio far = takes_infinite_far(format.mapping) ? Ratio() : Ratio(Dyadic(format.far));
  const auto quotient_or_infinity = [](const Ratio& a, const Ratio& b) -> std::optional<Real> {
    if (b.sign() == Sign::zero) return std::nullopt;
    return quotient(a, b);
  };
  switch (format.mapping) {
    case Mapping::standard:
    case Mapping::opengl:
      return quotient(near * far, far - s * (far - near));
    case Mapping::reversed:
      return quotient(near * far, near + s * (far - near));
    case Mapping::infinite:
      return quotient_or_infinity(near, one() - s);
    case Mapping::reversed_infinite:
      return quotient_or_infinity(near, s);
    case Mapping::linear:
      return near + s * (far - near);
    case Mapping::w:
      return s * far;
    case Mapping::log: {
      const Ratio c = Dyadic(format.c);
      return affine(power_minus_one(one() + c * far, s), quotient(one(), c), Ratio());
    }
    case Mapping::log_ulrich:
      return affine(power_minus_one(quotient(far, near), s), near, near);
  }
  return std::nullopt;
}

}  // namespace fathom
