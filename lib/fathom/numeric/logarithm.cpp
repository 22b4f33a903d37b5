#include "fathom/numeric/logarithm.h"

#include <stdexcept>

#include "fathom/numeric/big_float.h"

namespace fathom {
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

using Function = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

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

void require(bool holds, const char* what) {
  if (!holds) throw std::domain_error(what);
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
