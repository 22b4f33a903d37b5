#pragma once

#include <gmp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/double_word.h"
#include "fathom/numeric/interval.h"
#include "fathom/numeric/ratio.h"
#include "fathom/numeric/rounding.h"
#include "tests/effort.h"

namespace fathom::checks {

inline Dyadic exactly(double x) {
  return x;
}
inline Dyadic exactly(const WordPair& x) {
  return Dyadic(x.hi) + Dyadic(x.lo);
}

/// Collects |computed − exact| / bound: none may exceed 1, the greatest says how tight it is.
class Share {
 public:
  void add(const Dyadic& computed, const Ratio& exact, const Dyadic& bound) {
    if (bound.is_zero()) {
      EXPECT_EQ(compare(Ratio(computed), exact), 0);
      return;
    }
    const Ratio error = Ratio(computed) - exact;
    const double share = std::abs(round_to_binary64(error * Ratio(1.0, bound)));
    EXPECT_LE(share, 1);
    greatest_ = std::max(greatest_, share);
    ++count_;
  }
  template <class Real>
  void add(const Certified<Real>& x, const Ratio& exact) {
    if (std::isfinite(x.error)) add(exactly(x.value), exact, x.error);
  }
  /// Of an interval: |middle − exact| / half its width.
  void add(const Interval& x, const Ratio& exact) {
    const Dyadic lower(x.lower), upper(x.upper);
    add((lower + upper).scaled(-1), exact, (upper - lower).scaled(-1));
  }
  /// The greatest share; also written into the test's report (--gtest_output=json), by this name.
  double publish(const char* name) const {
    ::testing::Test::RecordProperty(name, std::to_string(greatest_));
    return greatest_;
  }
  [[nodiscard]] double greatest() const { return greatest_; }
  [[nodiscard]] int count() const { return count_; }

 private:
  double greatest_ = 0;
  int count_ = 0;
};

inline Dyadic exactly(mpz_srcptr integer) {
  Dyadic sum;  // through 53-bit pieces, the only way into a Dyadic
  mpz_t rest;
  mpz_init_set(rest, integer);
  while (mpz_sgn(rest) != 0) {
    long power = 0;
    const double piece = mpz_get_d_2exp(&power, rest);  // towards zero
    const Dyadic part = Dyadic(piece).scaled(power);
    sum += part;
    mpz_t taken;
    mpz_init_set(taken, part.significand());
    if (part.exponent() >= 0) {
      mpz_mul_2exp(taken, taken, static_cast<mp_bitcnt_t>(part.exponent()));
    } else {
      mpz_tdiv_q_2exp(taken, taken, static_cast<mp_bitcnt_t>(-part.exponent()));
    }
    mpz_sub(rest, rest, taken);
    mpz_clear(taken);
  }
  mpz_clear(rest);
  return sum;
}
inline Ratio exactly(mpq_srcptr x) {
  return {exactly(mpq_numref(x)), exactly(mpq_denref(x))};
}

/// A bound is no looser than this. Where fewer cases are run, less is found.
inline void expect_share(double found, double least) {
  if (effort == 1) {
    EXPECT_GT(found, least);
  }
}

/// √x with a relative error below 2⁻³⁰⁰, nothing beside the bounds it is compared with.
inline Ratio root(const Ratio& x) {
  if (x.sign() == Sign::zero) return {};
  mpz_t n;
  mpz_init(n);
  // √(n·2^e/d) = √(n·d·2^(e mod 2 + 2k))/(d·2^k)·2^⌊e/2⌋
  mpz_mul(n, x.numerator.significand(), x.denominator.significand());
  const long e = x.numerator.exponent() - x.denominator.exponent();
  const long odd = ((e % 2) + 2) % 2;
  mpz_mul_2exp(n, n, static_cast<mp_bitcnt_t>(odd) + 2 * 700);
  mpz_sqrt(n, n);
  Dyadic numerator = exactly(n).scaled((e - odd) / 2 - 700);
  Dyadic denominator = exactly(x.denominator.significand());
  mpz_clear(n);
  return {std::move(numerator), std::move(denominator)};
}

}  // namespace fathom::checks
