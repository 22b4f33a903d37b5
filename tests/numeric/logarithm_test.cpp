#include "fathom/numeric/logarithm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/numeric/random_numbers.h"
#include "tests/oracle/mpfr_rounding.h"

namespace fathom {
namespace {

Ratio ratio(double p, double q) {
  return {Dyadic(p), Dyadic(q)};
}

/// p/q as an MPFR number of 2000 bits.
void set(mpfr_ptr result, double p, double q) {
  mpfr_set_d(result, p, MPFR_RNDN);
  mpfr_div_d(result, result, q, MPFR_RNDN);
}

TEST(Logarithm, QuotientsOfPowersOfOneRationalAreRational) {
  EXPECT_EQ(*quotient_of_logarithms(Dyadic(8.0), Dyadic(4.0)).rational(), ratio(3, 2));
  EXPECT_EQ(*quotient_of_logarithms(ratio(9, 4), ratio(27, 8)).rational(), ratio(2, 3));
  EXPECT_EQ(*quotient_of_logarithms(Dyadic(1.0), Dyadic(7.0)).rational(), Ratio());
  EXPECT_EQ(*quotient_of_logarithms(Dyadic(6.0), Dyadic(36.0)).rational(), ratio(1, 2));
  // 2⁶⁴ and 2²⁰·3²⁰: exponents with a common divisor, but no powers of one rational.
  EXPECT_FALSE(quotient_of_logarithms(Dyadic(0x1p64), Dyadic(3486784401.0).scaled(20)).rational());
  EXPECT_FALSE(quotient_of_logarithms(Dyadic(2.0), Dyadic(3.0)).rational());
  EXPECT_FALSE(quotient_of_logarithms(Dyadic(8.0), Dyadic(12.0)).rational());
  EXPECT_FALSE(quotient_of_logarithms(ratio(9, 4), ratio(9, 2)).rational());
}

TEST(Logarithm, PowersAreRationalWhereTheBaseIsAPower) {
  EXPECT_EQ(*power_minus_one(ratio(9, 4), ratio(3, 2)).rational(), ratio(19, 8));
  EXPECT_EQ(*power_minus_one(Dyadic(5.0), Ratio()).rational(), Ratio());
  EXPECT_EQ(*power_minus_one(Dyadic(5.0), ratio(4, 2)).rational(), Ratio(Dyadic(24.0)));
  EXPECT_FALSE(power_minus_one(ratio(9, 5), ratio(1, 2)).rational());
  EXPECT_FALSE(power_minus_one(Dyadic(8.0), ratio(1, 2)).rational());
  EXPECT_FALSE(power_minus_one(Dyadic(8.0), Dyadic(0x1p-100)).rational());
}

TEST(Logarithm, RationalResultsRoundAsTies) {
  // 1/2·(2¹⁶ − 1) is a tie; the even neighbour is 2¹⁵.
  EXPECT_EQ(round_to_unorm(quotient_of_logarithms(Dyadic(3.0), Dyadic(9.0)), 16), 0x8000U);
  EXPECT_EQ(round_to_binary64(quotient_of_logarithms(Dyadic(3.0), Dyadic(9.0))), 0.5);
  EXPECT_EQ(compare(quotient_of_logarithms(Dyadic(3.0), Dyadic(9.0)), ratio(1, 2)), 0);
  EXPECT_GT(compare(quotient_of_logarithms(Dyadic(3.0), Dyadic(8.999)), ratio(1, 2)), 0);
}

TEST(Logarithm, RandomQuotientsAgreeWithMpfr) {
  std::mt19937_64 random(21);
  mpfr_t x, y;
  mpfr_inits2(2000, x, y, nullptr);
  for (int i = 0; i < 3000; ++i) {
    // 1 + tiny, moderate and huge.
    const double p = 1 + std::ldexp(1 + random() % 1000, static_cast<int>(random() % 100) - 52);
    const double q = 1 + std::ldexp(1 + random() % 1000, static_cast<int>(random() % 100) - 52);
    if (p == q) continue;
    set(x, p, 1);
    set(y, q, 1);
    mpfr_log(x, x, MPFR_RNDN);
    mpfr_log(y, y, MPFR_RNDN);
    mpfr_div(x, x, y, MPFR_RNDN);
    const Real ours = quotient_of_logarithms(Dyadic(p), Dyadic(q));
    const auto copy = [&](mpfr_ptr r) { return mpfr_set(r, x, MPFR_RNDN); };
    ASSERT_EQ(oracle::round_with(oracle::binary64, copy), round_to_binary64(ours)) << p << " " << q;
    ASSERT_EQ(oracle::round_with(oracle::binary32, copy), round_to_binary32(ours)) << p << " " << q;
  }
  mpfr_clears(x, y, nullptr);
}

TEST(Logarithm, RandomPowersAgreeWithMpfr) {
  std::mt19937_64 random(22);
  mpfr_t x, y;
  mpfr_inits2(2000, x, y, nullptr);
  for (int i = 0; i < 3000; ++i) {
    const double b = 1 + std::ldexp(1 + random() % 1000, static_cast<int>(random() % 100) - 52);
    const double p = random() % 65536, q = 65535;
    set(x, b, 1);
    set(y, p, q);
    mpfr_pow(x, x, y, MPFR_RNDN);
    mpfr_sub_ui(x, x, 1, MPFR_RNDN);
    const Real ours = power_minus_one(Dyadic(b), ratio(p, q));
    const auto copy = [&](mpfr_ptr r) { return mpfr_set(r, x, MPFR_RNDN); };
    ASSERT_EQ(oracle::round_with(oracle::binary64, copy), round_to_binary64(ours)) << b << " " << p;
  }
  mpfr_clears(x, y, nullptr);
}

TEST(Logarithm, AffineKeepsEnclosuresInOrder) {
  const Real x = quotient_of_logarithms(Dyadic(2.0), Dyadic(3.0));
  const Real down = affine(x, Dyadic(-2.0), Dyadic(5.0));
  const Enclosure e = down.enclose(60);
  EXPECT_LT(e.low, e.high);
  // log 2 / log 3 = 0.630929753…
  EXPECT_GT(compare(down, Dyadic(3.7381404)), 0);
  EXPECT_LT(compare(down, Dyadic(3.7381406)), 0);
}

TEST(Logarithm, WhatIsNotDefinedIsRefused) {
  EXPECT_THROW(quotient_of_logarithms(Dyadic(0.5), Dyadic(2.0)), std::domain_error);
  EXPECT_THROW(quotient_of_logarithms(Dyadic(2.0), Dyadic(1.0)), std::domain_error);
  EXPECT_THROW(power_minus_one(Dyadic(1.0), Dyadic(1.0)), std::domain_error);
  EXPECT_THROW(power_minus_one(Dyadic(2.0), Dyadic(-1.0)), std::domain_error);
}

}  // namespace
}  // namespace fathom
