#include "fathom/numeric/dyadic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::any_double;
using checks::few_bits;
using checks::Rational;

TEST(Dyadic, HoldsEveryFiniteDouble) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = any_double(random);
    const Interval point = enclose(Dyadic(x));
    EXPECT_EQ(point.lower, x);
    EXPECT_EQ(point.upper, x);
  }
  for (const double x : {0.0, -0.0, 5e-324, -5e-324, 1e308, 2.2250738585072014e-308}) {
    EXPECT_EQ(enclose(Dyadic(x)).lower, x);
    EXPECT_EQ(enclose(Dyadic(x)).upper, x);
  }
}

TEST(Dyadic, RefusesWhatIsNotFinite) {
  EXPECT_THROW(Dyadic{std::numeric_limits<double>::infinity()}, std::invalid_argument);
  EXPECT_THROW(Dyadic(std::nan("")), std::invalid_argument);
}

TEST(Dyadic, ArithmeticIsThatOfGmpRationals) {
  std::mt19937_64 random(2);
  Rational a, b, expected, actual;
  for (int i = 0; i < 20000; ++i) {
    const bool ties = i % 2 == 0;
    const double x = ties ? few_bits(random) : any_double(random);
    const double y = ties ? few_bits(random) : any_double(random);
    checks::set(a.q, x);
    checks::set(b.q, y);
    mpq_add(expected.q, a.q, b.q);
    checks::set(actual.q, Dyadic(x) + Dyadic(y));
    ASSERT_TRUE(mpq_equal(expected.q, actual.q)) << std::hexfloat << x << " + " << y;
    mpq_sub(expected.q, a.q, b.q);
    checks::set(actual.q, Dyadic(x) - Dyadic(y));
    ASSERT_TRUE(mpq_equal(expected.q, actual.q)) << std::hexfloat << x << " - " << y;
    mpq_mul(expected.q, a.q, b.q);
    checks::set(actual.q, Dyadic(x) * Dyadic(y));
    ASSERT_TRUE(mpq_equal(expected.q, actual.q)) << std::hexfloat << x << " * " << y;
    const int order = mpq_cmp(a.q, b.q);
    ASSERT_EQ(compare(Dyadic(x), Dyadic(y)), (order > 0) - (order < 0))
        << std::hexfloat << x << " against " << y;
  }
}

TEST(Dyadic, CompoundAssignmentTakesItself) {
  Dyadic x = 3.5;
  x += x;
  EXPECT_EQ(x, Dyadic(7));
  x *= x;
  EXPECT_EQ(x, Dyadic(49));
  x -= Dyadic(x);
  EXPECT_TRUE(x.is_zero());
}

TEST(Dyadic, EnclosureIsTheLeastInterval) {
  std::mt19937_64 random(3);
  Rational exact, end;
  for (int i = 0; i < 20000; ++i) {
    const Dyadic x = Dyadic(any_double(random)) + Dyadic(any_double(random)) * Dyadic(0.75);
    const Interval hull = enclose(x);
    checks::set(exact.q, x);
    if (std::isfinite(hull.lower)) {
      checks::set(end.q, hull.lower);
      ASSERT_LE(mpq_cmp(end.q, exact.q), 0);
    }
    if (std::isfinite(hull.upper)) {
      checks::set(end.q, hull.upper);
      ASSERT_GE(mpq_cmp(end.q, exact.q), 0);
    }
    if (hull.lower != hull.upper) {
      ASSERT_EQ(std::nextafter(hull.lower, std::numeric_limits<double>::infinity()), hull.upper);
    }
  }
}

TEST(Dyadic, EnclosureAtTheEndsOfTheRange) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double greatest = std::numeric_limits<double>::max();
  const Interval huge = enclose(Dyadic(greatest) * Dyadic(2.0));
  EXPECT_EQ(huge.lower, greatest);
  EXPECT_EQ(huge.upper, infinity);
  const Interval tiny = enclose(Dyadic(-5e-324) * Dyadic(0.5));
  EXPECT_EQ(tiny.lower, -5e-324);
  EXPECT_EQ(tiny.upper, 0.0);
}

TEST(Dyadic, TheTopIsTheLeastPowerOfTwoAbove) {
  EXPECT_EQ(Dyadic(1.0).top(), 1);
  EXPECT_EQ(Dyadic(-0.75).top(), 0);
  EXPECT_EQ(Dyadic(0x1p-1074).top(), -1073);
  const Dyadic even = Dyadic(3.0) + Dyadic(5.0);
  EXPECT_EQ(even.top(), 4);
  EXPECT_EQ((even * Dyadic(0x1p1000) * Dyadic(0x1p1000) - Dyadic(1.0)).top(), 2003);
}

}  // namespace
}  // namespace fathom
