#include <gtest/gtest.h>

#include "fathom/numeric/big_numbers.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

std::string quotient(unsigned long numerator, unsigned long denominator) {
  Integer n, d, result;
  mpz_set_ui(n, numerator);
  mpz_set_ui(d, denominator);
  divide_to_nearest_even(result, n, d);
  return to_string(result);
}

TEST(Integer, QuotientsAreRoundedToTheNearestAndTiesToEven) {
  EXPECT_EQ(quotient(0, 3), "0");
  EXPECT_EQ(quotient(1, 2), "0");
  EXPECT_EQ(quotient(3, 2), "2");
  EXPECT_EQ(quotient(5, 2), "2");
  EXPECT_EQ(quotient(7, 3), "2");
  EXPECT_EQ(quotient(8, 3), "3");
  EXPECT_EQ(quotient(25, 10), "2");
  EXPECT_EQ(quotient(35, 10), "4");
}

TEST(Integer, MagnitudesAreQuotientsOfIntegers) {
  const Ratio x(Dyadic(-0.375), Dyadic(5.0).scaled(70));
  const Fraction f = magnitude_as_fraction(x);
  EXPECT_GT(mpz_sgn(f.denominator.get()), 0);
  checks::Rational expected(x), ours;
  mpq_abs(expected.q, expected.q);
  mpz_set(mpq_numref(ours.q), f.numerator);
  mpz_set(mpq_denref(ours.q), f.denominator);
  mpq_canonicalize(ours.q);
  EXPECT_TRUE(mpq_equal(ours.q, expected.q));
}

TEST(Integer, IntegersOfAnySizeAndSignAreExactNumbers) {
  Integer value;
  EXPECT_TRUE(Dyadic::of(value).is_zero());
  mpz_ui_pow_ui(value, 3, 500);
  mpz_mul_2exp(value, value, 77);
  Dyadic expected(1.0);
  for (int i = 0; i < 500; ++i) expected *= Dyadic(3.0);
  EXPECT_EQ(Dyadic::of(value), expected.scaled(77));
  EXPECT_EQ(Dyadic::of(value, -80), expected.scaled(-3));
  mpz_neg(value, value);
  EXPECT_EQ(Dyadic::of(value), -expected.scaled(77));
}

TEST(Integer, MovingLeavesAZeroBehind) {
  Integer a;
  mpz_set_ui(a, 42);
  const Integer b(std::move(a));
  EXPECT_EQ(to_string(b), "42");
  EXPECT_EQ(to_string(a), "0");  // NOLINT(bugprone-use-after-move): it is what is asked
}

}  // namespace
}  // namespace fathom
