#include "fathom/numeric/rounding.h"

#include <bit>
#include <cmath>
#include <stdexcept>

#include "fathom/numeric/big_numbers.h"

namespace fathom {
namespace {

/// An IEEE 754 binary interchange format.
struct Format {
  int precision;           // bits of the significand, including the hidden one
  long least_exponent;     // exponent of the last bit of a subnormal
  long greatest_exponent;  // numbers are below 2^greatest_exponent
};
constexpr Format binary16{11, -24, 16};
constexpr Format binary32{24, -149, 128};
constexpr Format binary64{53, -1074, 1024};

/// Rounds a non-negative exact number in (or at the ends of) [2^(top−1), 2^(top+1)).
/// `nearest(q, e)` sets q to the integer nearest to the number over 2^e, ties to even.
///
/// The exponent e of the last bit kept starts from the lower estimate of the size. If the rounded
/// significand needs more than `precision` bits, the estimate was one too low or rounding carried
/// to the next power of two; in both cases rounding the *exact* number again with e + 1 is correct.
/// The encoding of significand and exponent as bits is monotone, so a carry from subnormal to
/// normal, or to infinity, needs no special care.
template <class Nearest>
std::uint64_t round_magnitude(const Format& format, long top, const Nearest& nearest) {
  long e = top - format.precision;
  if (e < format.least_exponent) e = format.least_exponent;
  Integer q;
  const std::uint64_t infinity =
      static_cast<std::uint64_t>(format.greatest_exponent - format.least_exponent -
                                 format.precision + 2)
      << (format.precision - 1);
  if (top > format.greatest_exponent + 1) return infinity;
  nearest(q, e);
  if (mpz_sizeinbase(q, 2) > static_cast<std::size_t>(format.precision)) nearest(q, ++e);
  const std::uint64_t significand = mpz_get_ui(q);
  const std::uint64_t hidden = std::uint64_t{1} << (format.precision - 1);
  if (significand < hidden) return significand;  // zero or subnormal: e is the least exponent
  const std::uint64_t bits =
      (static_cast<std::uint64_t>(e - format.least_exponent) << (format.precision - 1)) +
      significand;
  return bits < infinity ? bits : infinity;
}

long bit_length(mpz_srcptr value) {
  return static_cast<long>(mpz_sizeinbase(value, 2));
}

/// |x| rounded to the format's bits, without the sign bit.
std::uint64_t round_quotient(const Format& format, const Ratio& x) {
  if (x.sign() == Sign::zero) return 0;
  Integer numerator;
  mpz_abs(numerator, x.numerator.significand());
  mpz_srcptr denominator = x.denominator.significand();
  const long power = x.numerator.exponent() - x.denominator.exponent();
  // n / d lies in (2^(ln−ld−1), 2^(ln−ld+1)) for bit lengths ln and ld.
  const long top = bit_length(numerator) - bit_length(denominator) + power;
  return round_magnitude(format, top, [&](mpz_ptr q, long e) {
    const long shift = power - e;
    Integer scaled;
    if (shift >= 0) {
      mpz_mul_2exp(scaled, numerator, static_cast<mp_bitcnt_t>(shift));
      divide_to_nearest_even(q, scaled, denominator);
    } else {
      mpz_mul_2exp(scaled, denominator, static_cast<mp_bitcnt_t>(-shift));
      divide_to_nearest_even(q, numerator, scaled);
    }
  });
}

/// q = the integer nearest to √(n / d), ties to even, for n ≥ 0 and d > 0. The root is compared
/// with the midpoint m + ½ by the squares: √y > m + ½ ⇔ 4y > (2m + 1)², m = ⌊√y⌋ = ⌊√⌊y⌋⌋.
void root_to_nearest_even(mpz_ptr q, mpz_srcptr n, mpz_srcptr d) {
  Integer floor_y;
  mpz_tdiv_q(floor_y, n, d);
  mpz_sqrt(q, floor_y);
  Integer midpoint;  // (2m + 1)²·d
  mpz_mul_2exp(midpoint, q, 1);
  mpz_add_ui(midpoint, midpoint, 1);
  mpz_mul(midpoint, midpoint, midpoint);
  mpz_mul(midpoint, midpoint, d);
  Integer four_n;
  mpz_mul_2exp(four_n, n, 2);
  const int against_midpoint = mpz_cmp(four_n, midpoint);
  if (against_midpoint > 0 || (against_midpoint == 0 && mpz_odd_p(q))) mpz_add_ui(q, q, 1);
}

void refuse_negative(const Ratio& x) {
  if (x.sign() == Sign::negative) throw std::domain_error("the root of a negative number");
}

/// √x rounded to the format's bits.
std::uint64_t round_root(const Format& format, const Ratio& x) {
  refuse_negative(x);
  if (x.sign() == Sign::zero) return 0;
  const Fraction f = magnitude_as_fraction(x);
  const long difference = bit_length(f.numerator) - bit_length(f.denominator);
  // √x lies in (2^((difference−1)/2), 2^((difference+1)/2)).
  const long top = (difference + 1) >> 1;
  return round_magnitude(format, top, [&](mpz_ptr q, long e) {
    // √(x / 2^(2e))
    Integer n, d;
    const auto shift = static_cast<mp_bitcnt_t>(e < 0 ? -2 * e : 2 * e);
    mpz_mul_2exp(n, f.numerator, e < 0 ? shift : 0);
    mpz_mul_2exp(d, f.denominator, e < 0 ? 0 : shift);
    root_to_nearest_even(q, n, d);
  });
}

bool is_negative(const Ratio& x) {
  return x.sign() == Sign::negative;
}

}  // namespace

float round_to_binary32(const Ratio& x) {
  const auto bits = static_cast<std::uint32_t>(round_quotient(binary32, x));
  return std::bit_cast<float>(bits | (is_negative(x) ? 0x80000000U : 0U));
}

double round_to_binary64(const Ratio& x) {
  const std::uint64_t bits = round_quotient(binary64, x);
  return std::bit_cast<double>(bits | (is_negative(x) ? std::uint64_t{1} << 63 : 0));
}

std::optional<double> round_to_normal(const Ratio& x) {
  const double rounded = round_to_binary64(x);
  if (x.sign() != Sign::zero && !std::isnormal(rounded)) return std::nullopt;
  return rounded;
}

Binary16 round_to_binary16(const Ratio& x) {
  const auto bits = static_cast<std::uint16_t>(round_quotient(binary16, x));
  return {static_cast<std::uint16_t>(bits | (is_negative(x) ? 0x8000 : 0))};
}

float round_sqrt_to_binary32(const Ratio& x) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(round_root(binary32, x)));
}

double round_sqrt_to_binary64(const Ratio& x) {
  return std::bit_cast<double>(round_root(binary64, x));
}

std::optional<std::uint64_t> round_to_integer(const Ratio& x, std::uint64_t greatest) {
  const Fraction f = magnitude_as_fraction(x);
  Integer q;
  divide_to_nearest_even(q, f.numerator, f.denominator);
  if (is_negative(x) && mpz_sgn(q.get()) != 0) return std::nullopt;
  if (mpz_cmp_ui(q.get(), greatest) > 0) return std::nullopt;
  return mpz_get_ui(q);
}

std::optional<std::uint64_t> round_sqrt_to_integer(const Ratio& x, std::uint64_t greatest) {
  refuse_negative(x);
  const Fraction f = magnitude_as_fraction(x);
  Integer q;
  root_to_nearest_even(q, f.numerator, f.denominator);
  if (mpz_cmp_ui(q.get(), greatest) > 0) return std::nullopt;
  return mpz_get_ui(q);
}

std::optional<std::uint32_t> round_to_unorm(const Ratio& x, int bits) {
  if (is_negative(x) || compare(x, Ratio(Dyadic(1.0))) > 0) return std::nullopt;
  const double steps = static_cast<double>((std::uint64_t{1} << bits) - 1);
  const auto code = round_to_integer({x.numerator * Dyadic(steps), x.denominator}, 0xFFFFFFFF);
  return static_cast<std::uint32_t>(*code);
}

}  // namespace fathom
