#include "fathom/numeric/enclosed_sum.h"

#include "fathom/numeric/integer.h"

namespace fathom {
namespace {

constexpr long bits = 320;

/// The fraction times 2^power, of either sign; numerator and denominator stay integers.
void shift(mpz_ptr numerator, mpz_ptr denominator, long power) {
  if (power >= 0) {
    mpz_mul_2exp(numerator, numerator, static_cast<mp_bitcnt_t>(power));
  } else {
    mpz_mul_2exp(denominator, denominator, static_cast<mp_bitcnt_t>(-power));
  }
}

}  // namespace

void EnclosedSum::add(const Ratio& term) {
  Integer numerator, denominator, quotient, remainder;
  mpz_set(numerator, term.numerator.significand());
  mpz_set(denominator, term.denominator.significand());
  shift(numerator, denominator, bits + term.numerator.exponent() - term.denominator.exponent());
  mpz_fdiv_qr(quotient, remainder, numerator, denominator);
  if (mpz_sgn(remainder.get()) != 0) rounded_ += 1;
  floor_ += Dyadic::of(quotient, -bits);
}

void EnclosedSum::add(const EnclosedSum& part) {
  floor_ += part.floor_;
  rounded_ += part.rounded_;
}

Enclosure EnclosedSum::get() const {
  return {floor_, floor_ + Dyadic(rounded_).scaled(-bits)};
}

}  // namespace fathom
