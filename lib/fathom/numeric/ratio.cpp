#include "fathom/numeric/ratio.h"

#include <stdexcept>
#include <utility>

#include "fathom/numeric/big_numbers.h"

namespace fathom {

Ratio::Ratio(Dyadic num, Dyadic den) : numerator(std::move(num)), denominator(std::move(den)) {
  if (denominator.is_zero()) throw std::domain_error("a Ratio has a denominator other than zero");
  if (denominator.sign() == Sign::negative) {
    numerator = -numerator;
    denominator = -denominator;
  }
}

Ratio operator+(const Ratio& a, const Ratio& b) {
  return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
}

Ratio operator-(const Ratio& a, const Ratio& b) {
  return {a.numerator * b.denominator - b.numerator * a.denominator, a.denominator * b.denominator};
}

Ratio operator*(const Ratio& a, const Ratio& b) {
  return {a.numerator * b.numerator, a.denominator * b.denominator};
}

Ratio quotient(const Ratio& a, const Ratio& b) {
  return {a.numerator * b.denominator, a.denominator * b.numerator};
}

Ratio sum_of(std::vector<Ratio> terms) {
  while (terms.size() > 1) {
    const std::size_t half = (terms.size() + 1) / 2;
    for (std::size_t i = 0; i + half < terms.size(); ++i) terms[i] = terms[i] + terms[i + half];
    terms.resize(half);
  }
  return terms.empty() ? Ratio() : std::move(terms.front());
}

int compare(const Ratio& a, const Ratio& b) {
  return compare(a.numerator * b.denominator, b.numerator * a.denominator);
}

std::string to_fraction(const Ratio& x) {
  const Fraction f = in_lowest_terms(x);
  std::string text = x.sign() == Sign::negative ? "-" : "";
  text += to_string(f.numerator);
  if (mpz_cmp_ui(f.denominator.get(), 1) != 0) text.append("/").append(to_string(f.denominator));
  return text;
}

namespace {

/// 10^power times a fraction; the power may have either sign.
Fraction times_power_of_ten(const Fraction& f, long power) {
  Fraction scaled;
  Integer ten_to;
  mpz_ui_pow_ui(ten_to, 10, static_cast<unsigned long>(power < 0 ? -power : power));
  mpz_set(scaled.numerator, f.numerator);
  mpz_set(scaled.denominator, f.denominator);
  mpz_ptr side =
      power < 0 ? static_cast<mpz_ptr>(scaled.denominator) : static_cast<mpz_ptr>(scaled.numerator);
  mpz_mul(side, side, ten_to);
  return scaled;
}

}  // namespace

std::string to_decimal(const Ratio& x, int digits) {
  if (x.sign() == Sign::zero) return "0";
  const Fraction f = magnitude_as_fraction(x);
  // GMP's count of decimal digits is right or one too high, so this is a lower bound on the decimal
  // exponent of the first digit. An exponent that is too low shows as too many digits.
  long exponent = static_cast<long>(mpz_sizeinbase(f.numerator, 10)) -
                  static_cast<long>(mpz_sizeinbase(f.denominator, 10)) - 2;
  Integer code;
  std::string text;
  for (;; ++exponent) {
    const Fraction scaled = times_power_of_ten(f, digits - 1 - exponent);
    divide_to_nearest_even(code, scaled.numerator, scaled.denominator);
    text = to_string(code);
    if (text.size() <= static_cast<std::size_t>(digits)) break;
  }
  if (digits > 1) text.insert(1, 1, '.');
  return (x.sign() == Sign::negative ? "-" : "") + text + "e" + std::to_string(exponent);
}

}  // namespace fathom
