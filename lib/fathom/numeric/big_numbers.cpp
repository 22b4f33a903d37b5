#include "fathom/numeric/big_numbers.h"

#include <cstdint>

namespace fathom {

double bits_between(mpz_srcptr m, long first, long end) {
  constexpr long limb_bits = 64;
  static_assert(GMP_NUMB_BITS == limb_bits);
  const auto limb = static_cast<mp_size_t>(first / limb_bits);
  const long offset = first % limb_bits;
  std::uint64_t bits = mpz_getlimbn(m, limb) >> offset;
  if (offset != 0) bits |= mpz_getlimbn(m, limb + 1) << (limb_bits - offset);
  const std::uint64_t mask = (std::uint64_t{1} << (end - first)) - 1;
  return static_cast<double>(bits & mask);
}

void shift(mpz_ptr numerator, mpz_ptr denominator, long power) {
  if (power >= 0) {
    mpz_mul_2exp(numerator, numerator, static_cast<mp_bitcnt_t>(power));
  } else {
    mpz_mul_2exp(denominator, denominator, static_cast<mp_bitcnt_t>(-power));
  }
}

Fraction magnitude_as_fraction(const Ratio& x) {
  Fraction f;
  mpz_abs(f.numerator, x.numerator.significand());
  mpz_set(f.denominator, x.denominator.significand());
  shift(f.numerator, f.denominator, x.numerator.exponent() - x.denominator.exponent());
  return f;
}

Fraction in_lowest_terms(const Ratio& x) {
  Fraction f = magnitude_as_fraction(x);
  Integer divisor;
  mpz_gcd(divisor, f.numerator, f.denominator);
  mpz_divexact(f.numerator, f.numerator, divisor);
  mpz_divexact(f.denominator, f.denominator, divisor);
  return f;
}

void divide_to_nearest_even(mpz_ptr result, mpz_srcptr numerator, mpz_srcptr denominator) {
  Integer remainder;
  mpz_tdiv_qr(result, remainder, numerator, denominator);
  mpz_mul_2exp(remainder, remainder, 1);
  const int against_half = mpz_cmp(remainder, denominator);
  if (against_half > 0 || (against_half == 0 && mpz_odd_p(result))) mpz_add_ui(result, result, 1);
}

std::string to_string(const Integer& value) {
  std::string text(mpz_sizeinbase(value, 10) + 2, '\0');
  mpz_get_str(text.data(), 10, value);
  text.resize(text.find('\0'));
  return text;
}

}  // namespace fathom
