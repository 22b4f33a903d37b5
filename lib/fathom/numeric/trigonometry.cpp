#include "fathom/numeric/trigonometry.h"

#include <bit>
#include <numbers>
#include <stdexcept>

#include "fathom/numeric/big_float.h"

namespace fathom {
namespace {

using Function = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

constexpr mpfr_rnd_t opposite(mpfr_rnd_t direction) {
  return direction == MPFR_RNDD ? MPFR_RNDU : MPFR_RNDD;
}

/// A monotone function of degrees·π/half_turn ≥ 0, rounded to one side. `argument` is the side to
/// which the angle is rounded: the same of an increasing function, the other of a falling one.
Ratio at(Function function, double degrees, unsigned long half_turn, long bits, mpfr_rnd_t argument,
         mpfr_rnd_t direction) {
  BigFloat value(bits);
  mpfr_const_pi(value, argument);
  mpfr_mul_d(value, value, degrees, argument);
  mpfr_div_ui(value, value, half_turn, argument);
  function(value, value, direction);
  return to_dyadic(value);
}

Enclosure enclose_increasing(Function function, double degrees, unsigned long half_turn,
                             long bits) {
  return {at(function, degrees, half_turn, bits, MPFR_RNDD, MPFR_RNDD),
          at(function, degrees, half_turn, bits, MPFR_RNDU, MPFR_RNDU)};
}

Enclosure enclose_falling(Function function, double degrees, unsigned long half_turn, long bits) {
  return {at(function, degrees, half_turn, bits, opposite(MPFR_RNDD), MPFR_RNDD),
          at(function, degrees, half_turn, bits, opposite(MPFR_RNDU), MPFR_RNDU)};
}

void require(bool holds, const char* what) {
  if (!holds) throw std::domain_error(what);
}

}  // namespace

Real sine_of_degrees(double degrees) {
  require(degrees >= 0 && degrees <= 45, "the sine needs an angle of 0 to 45 degrees");
  return {[degrees](long bits) { return enclose_increasing(mpfr_sin, degrees, 180, bits); },
          [degrees]() -> std::optional<Ratio> {
            if (degrees == 0) return Ratio();
            return degrees == 30 ? std::optional<Ratio>(Dyadic(0.5)) : std::nullopt;
          }};
}

Real cosine_of_degrees(double degrees) {
  require(degrees >= 0 && degrees <= 45, "the cosine needs an angle of 0 to 45 degrees");
  return {[degrees](long bits) { return enclose_falling(mpfr_cos, degrees, 180, bits); },
          [degrees]() -> std::optional<Ratio> {
            return degrees == 0 ? std::optional<Ratio>(Dyadic(1.0)) : std::nullopt;
          }};
}

// Above 90 degrees it is tan(½·(180° − angle)), of which the difference is exact (Sterbenz): the
// enclosure keeps its relative width where the cotangent goes to 0.
Real cotangent_of_half_degrees(double angle) {
  require(angle > 0 && angle < 180, "the cotangent needs an angle between 0 and 180 degrees");
  return {[angle](long bits) {
            return angle <= 90 ? enclose_falling(mpfr_cot, angle, 360, bits)
                               : enclose_increasing(mpfr_tan, 180 - angle, 360, bits);
          },
          [angle]() -> std::optional<Ratio> {
            return angle == 90 ? std::optional<Ratio>(Dyadic(1.0)) : std::nullopt;
          }};
}

Real cotangent_of_half_radians(double angle) {
  require(angle > 0 && angle <= std::numbers::pi, "the cotangent needs an angle between 0 and pi");
  return {[angle](long bits) {
            const auto rounded = [&](mpfr_rnd_t direction) {
              BigFloat value(bits);  // at least 53: the angle is exact in it
              mpfr_set_d(value, angle, MPFR_RNDN);
              mpfr_div_2ui(value, value, 1, MPFR_RNDN);
              mpfr_cot(value, value, direction);
              return to_dyadic(value);
            };
            return Enclosure{rounded(MPFR_RNDD), rounded(MPFR_RNDU)};
          },
          []() -> std::optional<Ratio> { return std::nullopt; }};
}

// With a and b cosines of rational angles in degrees α and β (a sine is a cosine), 4·a·b is the sum
// of 2·cos(α + β) and 2·cos(α − β), which are algebraic integers. So it is one, too, and where it
// is rational it is an integer: the product is a multiple of ¼, a binary64 number with which no two
// of them border. Enclosures that are narrow enough round to one number.
double round_product_to_binary64(const Real& a, const Real& b) {
  const auto bits_of = [](const Ratio& x) {
    return std::bit_cast<std::uint64_t>(round_to_binary64(x));
  };
  for (long bits = 96;; bits *= 2) {
    const Enclosure x = a.enclose(bits), y = b.enclose(bits);
    const std::uint64_t low = bits_of(x.low * y.low);
    if (low == bits_of(x.high * y.high)) return std::bit_cast<double>(low);
  }
}

}  // namespace fathom
