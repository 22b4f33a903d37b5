// Bounds of binary64 arithmetic hold at every magnitude below 1 in size, where results underflow
// too.
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "tests/effort.h"
#include "tests/numeric/random_numbers.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using checks::Numbers;

static_assert(unit_roundoff<double> == 0x1p-53 && unit_roundoff<float> == 0x1p-24);

/// A number with a bound, and a number that it may stand for.
struct Meant {
  Certified<double> computed;
  Dyadic exact;

  explicit Meant(Numbers& n) {
    const double size = std::ldexp(n.unit(), -n.below(3) * 300 - n.below(60));
    computed = {size, std::abs(size) * std::ldexp(1, -n.below(60))};
    exact = Dyadic(size) + Dyadic(computed.error) * Dyadic(n.unit());
  }
};

void expect_within(const Certified<double>& computed, const Ratio& exact) {
  ASSERT_FALSE(std::isnan(computed.error));
  if (computed.error == infinity) return;
  const Ratio error = Ratio(Dyadic(computed.value)) - exact;
  ASSERT_LE(compare(error, Ratio(Dyadic(computed.error))), 0);
  ASSERT_GE(compare(error, Ratio(Dyadic(-computed.error))), 0);
  const Interval hull = enclose(computed);
  ASSERT_LE(compare(Ratio(Dyadic(hull.lower)), exact), 0);
  ASSERT_GE(compare(Ratio(Dyadic(hull.upper)), exact), 0);
}

TEST(CertifiedArithmetic, BoundsHoldWhateverUnderflows) {
  Numbers n(71);
  int known_quotients = 0;
  for (int i = 0; i < 40000 / checks::effort; ++i) {
    const Meant a(n), b(n);
    expect_within(a.computed + b.computed, Ratio(a.exact + b.exact));
    expect_within(a.computed * b.computed, Ratio(a.exact * b.exact));
    const Certified<double> quotient = a.computed / b.computed;
    if (!b.exact.is_zero()) expect_within(quotient, Ratio(a.exact, b.exact));
    known_quotients += std::isfinite(quotient.error);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(known_quotients, 10000 / checks::effort);
}

TEST(CertifiedArithmetic, AQuotientByWhatMayBeZeroIsNotKnown) {
  EXPECT_EQ((Certified<double>{1, 0} / Certified<double>{0.5, 0.5}).error, infinity);
  EXPECT_EQ((Certified<double>{1, 0} / Certified<double>{0, 0}).error, infinity);
  const Interval line = enclose(Certified<double>{1, infinity});
  EXPECT_EQ(line.lower, -infinity);
  EXPECT_EQ(line.upper, infinity);
}

TEST(CertifiedArithmetic, ARoundingIsSettledWhereBothEndsAgree) {
  EXPECT_EQ(settled_binary32({0.1, 0x1p-60}), 0.1F);
  EXPECT_EQ(settled_binary32({1 + 0x1p-24, 0x1p-60}), std::nullopt);  // about a tie
  EXPECT_EQ(settled_binary32({1, infinity}), std::nullopt);
  const std::optional<float> zero = settled_binary32({-0x1p-200, 0x1p-190});
  ASSERT_TRUE(zero);
  EXPECT_EQ(*zero, 0);
  EXPECT_FALSE(std::signbit(*zero));
}

}  // namespace
}  // namespace fathom
