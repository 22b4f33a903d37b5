#include "fathom/numeric/integer.h"

namespace fathom {

Fraction magnitude_as_fraction(const Ratio& x) {
  Fraction f;
  mpz_abs(f.numerator, x.numerator.significand());
  mpz_set(f.denominator, x.denominator.significand());
  const long power = x.numerator.exponent() - x.denominator.exponent();
  if (power >= 0) {
    mpz_mul_2exp(f.numerator, f.numerator, static_cast<mp_bitcnt_t>(power));
  } else {
    mpz_mul_2exp(f.denominator, f.denominator, static_cast<mp_bitcnt_t>(-power));
  }
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
