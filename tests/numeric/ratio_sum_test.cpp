// Sums of quotients and quotients of such sums, against the exact sums.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/numeric/real_sums.h"

namespace fathom {
namespace {

/// Quotients with different denominators, about as great as `scale`.
std::vector<Ratio> random_terms(std::mt19937_64& random, std::size_t count, double scale,
                                bool with_signs) {
  std::vector<Ratio> terms;
  while (terms.size() < count) {
    const double p = scale * static_cast<double>(1 + random() % 1000);
    const double q = static_cast<double>(1 + random() % 1000);
    terms.push_back({Dyadic(with_signs && random() % 2 == 0 ? -p : p), Dyadic(q)});
  }
  return terms;
}

TEST(RatioSum, RoundsAsTheExactSum) {
  std::mt19937_64 random(1901);
  for (const double scale : {1.0, 0x1p200, 0x1p-200, 0x1p-400}) {
    for (const std::size_t count : {1U, 4U, 5U, 40U}) {
      SCOPED_TRACE(::testing::Message() << scale << ' ' << count);
      const std::vector<Ratio> over = random_terms(random, count, scale, true);
      const std::vector<Ratio> under = random_terms(random, count, scale, false);
      EXPECT_EQ(round_to_binary64(real_sum(over)), round_to_binary64(sum_of(over)));
      EXPECT_EQ(round_to_binary64(real_quotient(over, under)),
                round_to_binary64(quotient(sum_of(over), sum_of(under))));
    }
  }
}

// What no enclosure decides: sums that cancel, and middles between two numbers.
TEST(RatioSum, DecidesExactly) {
  std::mt19937_64 random(7);
  std::vector<Ratio> over = random_terms(random, 20, 1, false);
  const std::vector<Ratio> under = random_terms(random, 40, 1, false);
  for (std::size_t k = 0; k < 20; ++k) {
    const Ratio term = over[19 - k];
    over.push_back({-term.numerator, term.denominator});
  }
  EXPECT_EQ(round_to_binary64(real_sum(over)), 0);
  EXPECT_EQ(round_to_binary64(real_quotient(over, under)), 0);
  // (1 + 2⁻⁵³) · 6 as sixths, over 6.
  const std::vector<Ratio> sixths(36, {Dyadic(1.0) + Dyadic(0x1p-53), Dyadic(6.0)});
  EXPECT_EQ(round_to_binary64(real_quotient(sixths, {Dyadic(3.0), Dyadic(3.0)})), 1);
}

TEST(RatioSum, QuotientsOfEnclosures) {
  const Ratio one(Dyadic(1.0)), two(Dyadic(2.0)), four(Dyadic(4.0));
  const auto negative = [](const Ratio& x) { return Ratio(-x.numerator, x.denominator); };
  const Enclosure under{two, four};
  const Enclosure positive = quotient({one, two}, under);
  EXPECT_EQ(positive.low, quotient(one, four));
  EXPECT_EQ(positive.high, one);
  const Enclosure below = quotient({negative(two), negative(one)}, under);
  EXPECT_EQ(below.low, negative(one));
  EXPECT_EQ(below.high, negative(quotient(one, four)));
  const Enclosure around = quotient({negative(one), one}, under);
  EXPECT_EQ(around.low, negative(quotient(one, two)));
  EXPECT_EQ(around.high, quotient(one, two));
}

}  // namespace
}  // namespace fathom
