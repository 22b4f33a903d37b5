#include "fathom/fast/coverage/certain_sign.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using fast::is_certainly_negative;

TEST(CertainSign, OnPaper) {
  // x + y − 7 over [1, 3] × [2, 4]: 0 at the corner where it is greatest.
  EXPECT_FALSE(is_certainly_negative(1, 1, -7, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(1, 1, -7.25, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(1, 1, -7.25, 0.125, {1, 3, 2, 4}));
  EXPECT_FALSE(is_certainly_negative(1, 1, -7.25, 0.25, {1, 3, 2, 4}));
  // Greatest at the left, at the top, anywhere.
  EXPECT_TRUE(is_certainly_negative(-1, 1, -3.5, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(1, -1, -1.5, 0, {1, 3, 2, 4}));
  EXPECT_TRUE(is_certainly_negative(0, 0, -1, 0, {1, 3, 2, 4}));
  EXPECT_FALSE(is_certainly_negative(0, 0, 0, 0, {1, 3, 2, 4}));
  EXPECT_FALSE(is_certainly_negative(0, 0, -1, INFINITY, {1, 3, 2, 4}));
}

/// Of small integers, which nothing rounds: as at the four corners.
TEST(CertainSign, IsThatOfAllCorners) {
  testing::Numbers n(67);
  int negative = 0;
  for (int i = 0; i < 2000; ++i) {
    const double a = n.below(9) - 4, b = n.below(9) - 4, c = n.below(80) - 60, error = n.below(3);
    const double left = n.below(9) - 4, top = n.below(9) - 4;
    const double right = left + n.below(6), bottom = top + n.below(6);
    double greatest = -INFINITY;
    for (const double x : {left, right}) {
      for (const double y : {top, bottom}) greatest = std::max(greatest, c + a * x + b * y);
    }
    EXPECT_EQ(is_certainly_negative(a, b, c, error, {left, right, top, bottom}), greatest < -error);
    negative += greatest < -error;
  }
  EXPECT_GT(negative, 500);
  EXPECT_LT(negative, 1500);
}

}  // namespace
}  // namespace fathom
