#pragma once

#include <gmp.h>
#include <mpfr.h>

#include <string>

#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/ratio.h"

/// Numbers of GMP and MPFR that free their memory. Only for .cpp files of this module.
namespace fathom {

/// An mpz_t.
class Integer {
 public:
  Integer() { mpz_init(value_); }
  Integer(Integer&& other) noexcept {
    mpz_init(value_);
    mpz_swap(value_, other.value_);
  }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
  Integer& operator=(Integer&&) = delete;
  ~Integer() { mpz_clear(value_); }
  operator mpz_ptr() { return value_; }
  operator mpz_srcptr() const { return value_; }
  /// For GMP's macros, in which the conversions do not take effect.
  [[nodiscard]] mpz_srcptr get() const { return value_; }

 private:
  mpz_t value_;
};

/// The bits of |m| from place `first` up to `end`, at most 53, as an integer.
double bits_between(mpz_srcptr m, long first, long end);

/// A non-negative quotient of integers; the denominator is positive.
struct Fraction {
  Integer numerator;
  Integer denominator;
};

/// Multiplies a quotient of integers, of either sign, by 2^power.
void shift(mpz_ptr numerator, mpz_ptr denominator, long power);

/// |x| as a quotient of integers, not reduced.
Fraction magnitude_as_fraction(const Ratio& x);
/// The same in lowest terms.
Fraction in_lowest_terms(const Ratio& x);

/// The integer nearest to numerator / denominator, both non-negative, ties to even.
void divide_to_nearest_even(mpz_ptr result, mpz_srcptr numerator, mpz_srcptr denominator);

std::string to_string(const Integer& value);

/// An mpfr_t.
class BigFloat {
 public:
  explicit BigFloat(long bits) { mpfr_init2(value_, bits); }
  BigFloat(const BigFloat&) = delete;
  BigFloat& operator=(const BigFloat&) = delete;
  ~BigFloat() { mpfr_clear(value_); }
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

/// The value of a finite x, exactly.
inline Dyadic to_dyadic(mpfr_srcptr x) {
  if (mpfr_zero_p(x) != 0) return {};
  Integer significand;
  const mpfr_exp_t exponent = mpfr_get_z_2exp(significand, x);
  return Dyadic::of(significand, exponent);
}

}  // namespace fathom
