// Sums of roots against MPFR at 2000 bits, and those that are rational.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <random>

#include "fathom/numeric/real_sums.h"

namespace fathom {
namespace {

Ratio over(double numerator, double denominator) {
  return {Dyadic(numerator), Dyadic(denominator)};
}

TEST(RootSum, RoundsAsMpfrDoes) {
  std::mt19937_64 random(1940);
  mpfr_t sum, term, weights;
  mpfr_inits2(2000, sum, term, weights, nullptr);
  for (int i = 0; i < 300; ++i) {
    RootSum roots, positive;
    mpfr_set_zero(sum, 1);
    mpfr_set_zero(weights, 1);
    const int count = 1 + static_cast<int>(random() % 6);
    for (int k = 0; k < count; ++k) {
      const double p = static_cast<double>(random() % 2001) - 1000,
                   q = 1 + static_cast<double>(random() % 1000),
                   r = std::ldexp(static_cast<double>(1 + random() % 50),
                                  static_cast<int>(random() % 9) - 4);
      roots.add(over(p, q), r);
      positive.add(over(1, q), r);
      mpfr_set_d(term, r, MPFR_RNDN);
      mpfr_sqrt(term, term, MPFR_RNDN);
      mpfr_div_d(term, term, q, MPFR_RNDN);
      mpfr_add(weights, weights, term, MPFR_RNDN);
      mpfr_mul_d(term, term, p, MPFR_RNDN);
      mpfr_add(sum, sum, term, MPFR_RNDN);
    }
    EXPECT_EQ(round_to_binary64(roots.value()), mpfr_get_d(sum, MPFR_RNDN)) << i;
    mpfr_div(sum, sum, weights, MPFR_RNDN);
    EXPECT_EQ(round_to_binary64(quotient(roots, positive)), mpfr_get_d(sum, MPFR_RNDN)) << i;
  }
  mpfr_clears(sum, term, weights, nullptr);
}

TEST(RootSum, KnowsWhenItIsRational) {
  RootSum cancels;
  cancels.add(over(1, 1), 2.0);
  cancels.add(over(1, 3), 8.0);
  cancels.add(over(-5, 3), 2.0);
  EXPECT_EQ(round_to_binary64(cancels.value()), 0);
  EXPECT_EQ(cancels.value().rational(), Ratio());
  cancels.add(over(1, 3), 2.25);
  EXPECT_EQ(cancels.value().rational(), over(1, 2));
  cancels.add(over(1, 1), 3.0);
  EXPECT_EQ(cancels.value().rational(), std::nullopt);
  // (7√2 + 7√3)/(3√2 + √27) = 7/3
  RootSum a, b;
  a.add(over(7, 1), 2.0);
  a.add(over(7, 1), 3.0);
  b.add(over(3, 1), 2.0);
  b.add(over(1, 1), 27.0);
  EXPECT_EQ(quotient(a, b).rational(), over(7, 3));
  b.add(over(1, 1), 27.0);
  EXPECT_EQ(quotient(a, b).rational(), std::nullopt);
  a.add(over(1, 1), 5.0);
  EXPECT_EQ(quotient(a, b).rational(), std::nullopt);
}

// Primes of the residues that lead to classes may divide radicands.
TEST(RootSum, FindsClassesOfAnyRadicands) {
  constexpr double prime = 2147483659.0;  // the first above 2³¹
  for (const double radicand : {prime, 2 * prime, 3.0}) {
    RootSum cancels;
    cancels.add(over(3, 1), radicand);
    cancels.add(over(1, 1), 5.0);
    cancels.add(over(-1, 1), Dyadic(radicand) * Dyadic(9.0));
    EXPECT_EQ(cancels.value().rational(), std::nullopt);
    cancels.add(over(-1, 2), 20.0);
    EXPECT_EQ(cancels.value().rational(), Ratio());
    // A square of the prime within the radicand takes its residue away from one of the two.
    const Dyadic square = Dyadic(prime) * Dyadic(prime);
    cancels.add(over(prime, 1), radicand);
    cancels.add(over(-1, 1), Dyadic(radicand) * square);
    EXPECT_EQ(cancels.value().rational(), Ratio());
    RootSum reversed;
    reversed.add(over(-1, 1), Dyadic(radicand) * square);
    reversed.add(over(prime, 1), radicand);
    EXPECT_EQ(reversed.value().rational(), Ratio());
  }
}

// Many classes: each is found without comparing it with all others.
TEST(RootSum, DecidesManyClasses) {
  RootSum cancels;
  constexpr int count = 20000;
  for (int k = 0; k < count; ++k) {
    cancels.add(over(1, 3), Dyadic(4.0 * k + 3));
    cancels.add(over(-1, 6), Dyadic(4.0) * Dyadic(4.0 * k + 3));
  }
  EXPECT_EQ(cancels.value().rational(), Ratio());
}

// Halfway between two numbers, and next to that.
TEST(RootSum, RoundsMiddlesToEven) {
  RootSum middle;
  middle.add(Ratio(Dyadic(1.0)), 1.0);
  middle.add(Ratio(Dyadic(0x1p-53)), 1.0);
  EXPECT_EQ(round_to_binary64(middle.value()), 1);
  middle.add(Ratio(Dyadic(0x1p-300)), 2.0);
  EXPECT_EQ(round_to_binary64(middle.value()), 1 + 0x1p-52);
}

TEST(ExactRoot, OfSquaresOnly) {
  EXPECT_EQ(exact_root(0.0), Dyadic());
  EXPECT_EQ(exact_root(2.25), Dyadic(1.5));
  EXPECT_EQ(exact_root(0x1p-301), std::nullopt);
  EXPECT_EQ(exact_root(0x1p-300), Dyadic(0x1p-150));
  EXPECT_EQ(exact_root(-4.0), std::nullopt);
}

}  // namespace
}  // namespace fathom
