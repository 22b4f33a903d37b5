#include "fathom/numeric/double_word.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/effort.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::exactly;
using checks::Numbers;
using checks::root;
using checks::Share;

template <bool fused>
void expect_operations_within_their_bounds() {
  using Real = DoubleWord<fused>;
  const double u2 = 0x1p-106;
  Numbers n(31);
  Share sum, product, scaled, quotient, square_root_share;
  const auto relative = [&](Share& share, const WordPair& computed, const Ratio& exact,
                            double factor) {
    const Ratio size = exact.sign() == Sign::negative ? Ratio() - exact : exact;
    // bound = factor·u²·|exact|: both sides times the denominator, to have a dyadic bound
    share.add(exactly(computed) * size.denominator, exact * Ratio(size.denominator),
              Dyadic(factor * u2) * size.numerator);
  };
  for (int i = 0; i < 40000 / checks::effort; ++i) {
    Real x = n.word_pair(), y = n.word_pair();
    if (n.below(3) == 0) y = Real(-x.hi, x.lo * n.unit());  // cancels
    const Dyadic X = exactly(WordPair(x)), Y = exactly(WordPair(y));
    if (X.is_zero() || Y.is_zero()) continue;
    relative(sum, x + y, Ratio(X + Y), 3.01);
    relative(sum, x - y, Ratio(X - Y), 3.01);
    relative(product, x * y, Ratio(X * Y), 7);
    relative(scaled, x * y.hi, Ratio(X * Dyadic(y.hi)), 2);
    relative(quotient, x / y, Ratio(X, Y), 15.01);
    if (X.sign() == Sign::positive) {
      relative(square_root_share, square_root(x), root(Ratio(X)), 8);
    }
  }
  EXPECT_GT(square_root_share.count(), 5000 / checks::effort);
  if (checks::effort > 1) return;  // too few cases to come near the bounds
  EXPECT_GT(sum.publish("sum"), 0.3);
  EXPECT_GT(product.publish("product"), 0.3);
  EXPECT_GT(scaled.publish("scaled"), 0.5);
  EXPECT_GT(quotient.publish("quotient"), 0.2);
  EXPECT_GT(square_root_share.publish("square_root_share"), 0.3);
}

TEST(DoubleWord, OperationsStayWithinTheirBoundsWithFma) {
  expect_operations_within_their_bounds<true>();
}
TEST(DoubleWord, OperationsStayWithinTheirBoundsWithoutFma) {
  expect_operations_within_their_bounds<false>();
}

TEST(DoubleWord, SumsAndProductsOfTwoNumbersAreExact) {
  Numbers n(32);
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    const double a = std::ldexp(n.unit(), n.below(201) - 100);
    const double b = std::ldexp(n.unit(), n.below(201) - 100);
    EXPECT_EQ(exactly(two_sum(a, b)), Dyadic(a) + Dyadic(b));
    EXPECT_EQ(exactly(two_product<true>(a, b)), Dyadic(a) * Dyadic(b));
    EXPECT_EQ(exactly(two_product<false>(a, b)), Dyadic(a) * Dyadic(b));
  }
}

}  // namespace
}  // namespace fathom
