#include "fathom/numeric/transcendental.h"

#include <bit>
#include <numbers>
#include <stdexcept>

#include "fathom/numeric/big_numbers.h"

namespace fathom {
namespace {

/// A function of MPFR.
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

// Above 90 degrees it is tan(½·(180° − angle)). The difference is exact (Sterbenz), so the
// enclosure keeps its relative width when the cotangent approaches 0.
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

Real pi() {
  return {[](long bits) {
            const auto rounded = [&](mpfr_rnd_t direction) {
              BigFloat value(bits);
              mpfr_const_pi(value, direction);
              return to_dyadic(value);
            };
            return Enclosure{rounded(MPFR_RNDD), rounded(MPFR_RNDU)};
          },
          []() -> std::optional<Ratio> { return std::nullopt; }};
}

Real reciprocal_of_pi() {
  return {[](long bits) {
            const Enclosure around = pi().enclose(bits);
            return Enclosure{quotient(Dyadic(1.0), around.high), quotient(Dyadic(1.0), around.low)};
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

// Sines and cosines on a grid.
namespace {

/// The function in `precision` bits, rounded to one side, then to the nearest multiple.
void round_on_grid(mpz_ptr result, Function function, double radians, long bits, long precision,
                   mpfr_rnd_t side) {
  BigFloat value(precision);
  mpfr_set_d(value, radians, MPFR_RNDN);  // exact: there are at least 53 bits
  function(value, value, side);
  mpfr_mul_2si(value, value, bits, MPFR_RNDN);
  mpfr_get_z(result, value, MPFR_RNDN);
}

Dyadic on_grid(Function function, double radians, long bits) {
  for (long precision = bits + 64;; precision *= 2) {
    Integer below, above;
    round_on_grid(below, function, radians, bits, precision, MPFR_RNDD);
    round_on_grid(above, function, radians, bits, precision, MPFR_RNDU);
    if (mpz_cmp(below, above) == 0) return Dyadic::of(below, -bits);
  }
}

}  // namespace

Dyadic sine_on_grid(double radians, long bits) {
  return on_grid(mpfr_sin, radians, bits);
}

Dyadic cosine_on_grid(double radians, long bits) {
  return on_grid(mpfr_cos, radians, bits);
}

// Logarithms and powers.
namespace {

/// x ≥ 0 rounded in a direction.
void set(mpfr_ptr result, const Ratio& x, mpfr_rnd_t direction) {
  Fraction f = magnitude_as_fraction(x);
  mpq_t q;
  mpq_init(q);
  mpz_swap(mpq_numref(q), f.numerator);
  mpz_swap(mpq_denref(q), f.denominator);
  mpfr_set_q(result, q, direction);
  mpq_clear(q);
}

/// An increasing function at x ≥ 0, rounded to one side: the argument is rounded to that side, and
/// so is the value.
Ratio at(Function function, const Ratio& x, long bits, mpfr_rnd_t direction) {
  BigFloat value(bits);
  set(value, x, direction);
  function(value, value, direction);
  return to_dyadic(value);
}

/// log a / log b enclosed. Logarithms of 1 + x keep their relative precision if x is small.
Enclosure enclose_quotient(const Ratio& a, const Ratio& b, long bits) {
  const Ratio one = Dyadic(1.0);
  const Ratio x = a - one, y = b - one;
  return {quotient(at(mpfr_log1p, x, bits, MPFR_RNDD), at(mpfr_log1p, y, bits, MPFR_RNDU)),
          quotient(at(mpfr_log1p, x, bits, MPFR_RNDU), at(mpfr_log1p, y, bits, MPFR_RNDD))};
}

/// b^e − 1 = exp(e·log b) − 1 enclosed.
Enclosure enclose_power(const Ratio& b, const Ratio& e, long bits) {
  const Ratio y = b - Dyadic(1.0);
  return {at(mpfr_expm1, e * at(mpfr_log1p, y, bits, MPFR_RNDD), bits, MPFR_RNDD),
          at(mpfr_expm1, e * at(mpfr_log1p, y, bits, MPFR_RNDU), bits, MPFR_RNDU)};
}

Ratio to_ratio(const Fraction& f) {
  return {Dyadic::of(f.numerator), Dyadic::of(f.denominator)};
}

/// Replaces a fraction > 1 in lowest terms by its k-th root if that is rational: numerator and
/// denominator have no common factor, so both must be k-th powers.
bool take_root(Fraction& f, unsigned long k) {
  if (k > mpz_sizeinbase(f.numerator, 2)) return false;  // 2^k exceeds the numerator
  Integer n, d;
  if (mpz_root(n, f.numerator, k) == 0 || mpz_root(d, f.denominator, k) == 0) return false;
  mpz_swap(f.numerator, n);
  mpz_swap(f.denominator, d);
  return true;
}

/// A rational > 1 as root^exponent with the greatest exponent.
struct PrimitivePower {
  Fraction root;
  unsigned long exponent = 1;
};

PrimitivePower primitive_power(const Ratio& x) {
  PrimitivePower power{in_lowest_terms(x)};
  // A composite k fails wherever its prime factors did, so only primes succeed.
  for (unsigned long k = 2; k <= mpz_sizeinbase(power.root.numerator, 2); ++k) {
    while (take_root(power.root, k)) power.exponent *= k;
  }
  return power;
}

std::optional<Ratio> rational_quotient(const Ratio& a, const Ratio& b) {
  const Ratio one = Dyadic(1.0);
  if (a == one) return Ratio();
  const PrimitivePower p = primitive_power(a), q = primitive_power(b);
  const bool same = mpz_cmp(p.root.numerator.get(), q.root.numerator.get()) == 0 &&
                    mpz_cmp(p.root.denominator.get(), q.root.denominator.get()) == 0;
  if (!same) return std::nullopt;
  return Ratio(Dyadic(static_cast<double>(p.exponent)), Dyadic(static_cast<double>(q.exponent)));
}

std::optional<Ratio> rational_power_minus_one(const Ratio& b, const Ratio& e) {
  if (e.sign() == Sign::zero) return Ratio();
  const Fraction exponent = in_lowest_terms(e);
  Fraction root = in_lowest_terms(b);
  if (mpz_fits_ulong_p(exponent.denominator.get()) == 0) return std::nullopt;
  const unsigned long v = mpz_get_ui(exponent.denominator);
  if (v > 1 && !take_root(root, v)) return std::nullopt;
  const unsigned long u = mpz_get_ui(exponent.numerator);
  mpz_pow_ui(root.numerator, root.numerator, u);
  mpz_pow_ui(root.denominator, root.denominator, u);
  return to_ratio(root) - Dyadic(1.0);
}

}  // namespace

Real quotient_of_logarithms(const Ratio& a, const Ratio& b) {
  const Ratio one = Dyadic(1.0);
  require(compare(a, one) >= 0 && compare(b, one) > 0, "log a / log b needs a >= 1 and b > 1");
  return {[a, b](long bits) { return enclose_quotient(a, b, bits); },
          [a, b] { return rational_quotient(a, b); }};
}

Real natural_logarithm(const Ratio& a) {
  const Ratio one = Dyadic(1.0);
  require(compare(a, one) >= 0, "log a needs a >= 1");
  return {
      [x = a - one](long bits) {
        return Enclosure{at(mpfr_log1p, x, bits, MPFR_RNDD), at(mpfr_log1p, x, bits, MPFR_RNDU)};
      },
      [is_one = a == one]() -> std::optional<Ratio> {
        return is_one ? std::optional(Ratio()) : std::nullopt;
      }};
}

Real power_minus_one(const Ratio& b, const Ratio& e) {
  require(compare(b, Dyadic(1.0)) > 0 && e.sign() != Sign::negative,
          "b^e - 1 needs b > 1 and e >= 0");
  return {[b, e](long bits) { return enclose_power(b, e, bits); },
          [b, e] { return rational_power_minus_one(b, e); }};
}

}  // namespace fathom
