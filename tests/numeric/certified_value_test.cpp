// Numbers with errors, at all magnitudes: bounds hold where results and bounds underflow, and only
// what is exact has an error of 0.
#include "fathom/numeric/certified_value.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/numeric/certified_rounding.h"
#include "tests/effort.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::exactly;
using checks::Numbers;
using checks::Share;

/// A number with a bound, and a number that it may stand for.
template <class Real>
struct MeantValue {
  Certified<Real> computed;
  Dyadic exact;

  MeantValue(const Real& value, double error, double part) : computed{value, error} {
    exact = exactly(value) + Dyadic(error) * Dyadic(part);
  }
};

double scaled(double x, int power) {
  return std::ldexp(x, power);
}
template <bool fused>
DoubleWord<fused> scaled(const DoubleWord<fused>& x, int power) {
  return two_sum(std::ldexp(x.hi, power), std::ldexp(x.lo, power));
}

/// Of any exponent, or near the ends of the range; some are exact, some 0, some err by as much as
/// they are large.
template <class Real>
MeantValue<Real> any_number(Numbers& n) {
  const int power = n.below(2) ? n.below(1900) - 1074 : -1074 + n.below(130);
  const Real value = n.below(16) == 0 ? Real(0.0) : scaled(entry<Real>(n.word_pair()), power);
  const bool is_exact = n.below(3) == 0;
  const double error = std::ldexp(std::abs(nearest(value)), -n.below(2) * (20 + n.below(100)));
  return {value, is_exact ? 0 : error, n.unit()};
}

/// The result must be certain wherever nothing overflows.
template <class Real>
void expect_within(const Certified<Real>& computed, const Ratio& exact, Share& share) {
  if (std::isnan(computed.error) || std::isinf(computed.error)) return;
  share.add(exactly(computed.value), exact, computed.error);  // no error: must be equal
}

template <class Real>
void expect_bounds_at_all_magnitudes() {
  Numbers n(77);
  Share sums, products, quotients;
  for (int i = 0; i < 60000 / checks::effort; ++i) {
    const auto x = any_number<Real>(n), y = any_number<Real>(n);
    expect_within(sum(x.computed, y.computed), Ratio(x.exact + y.exact), sums);
    expect_within(product(x.computed, y.computed), Ratio(x.exact * y.exact), products);
    if (y.exact.is_zero()) continue;
    expect_within(quotient(x.computed, y.computed), Ratio(x.exact, y.exact), quotients);
  }
  EXPECT_GT(sums.count(), 20000 / checks::effort);
  EXPECT_GT(products.count(), 20000 / checks::effort);
  EXPECT_GT(quotients.count(), 10000 / checks::effort);
}

TEST(CertifiedValue, BoundsHoldAtAllMagnitudesInBinary64) {
  expect_bounds_at_all_magnitudes<double>();
}
TEST(CertifiedValue, BoundsHoldAtAllMagnitudesInDoubleWords) {
  expect_bounds_at_all_magnitudes<DoubleWord<true>>();
  expect_bounds_at_all_magnitudes<DoubleWord<false>>();
}

/// A value whose bound underflows used to count as exact, and was rounded as if it were.
TEST(CertifiedValue, AProductThatUnderflowsIsNotExact) {
  using Real = DoubleWord<false>;
  const Certified<Real> tiny{Real(0x1.8p-500), 0}, small{Real(0x1.0000000000001p-530), 0};
  const auto below = product(tiny, small);
  EXPECT_GT(below.error, 0);
  EXPECT_FALSE(to_binary64(below.value, below.error));
  EXPECT_FALSE(to_binary32(below.value, below.error));
  const auto ratio = quotient(tiny, {Real(0x1.8000000000001p+530), 0});
  EXPECT_GT(ratio.error, 0);
  EXPECT_FALSE(to_binary64(ratio.value, ratio.error));
}

TEST(CertifiedValue, AFactorThatIsExactlyZeroLeavesAnExactZero) {
  const Certified<double> zero{0, 0}, about{-3, 0x1p-60}, perhaps_zero{0, 0x1p-60};
  for (const auto& x : {product(zero, about), product(about, zero), quotient(zero, about)}) {
    EXPECT_EQ(x.error, 0);
    EXPECT_EQ(x.value, 0);
    EXPECT_FALSE(std::signbit(x.value));
  }
  EXPECT_GT(product(perhaps_zero, about).error, 0);
  EXPECT_TRUE(std::isinf(quotient(about, zero).error));
  EXPECT_TRUE(std::isinf(quotient(zero, zero).error));
  EXPECT_TRUE(std::isinf(quotient(about, perhaps_zero).error));
}

}  // namespace
}  // namespace fathom
