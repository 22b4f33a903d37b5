#include "fathom/pipeline/scan/arithmetic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/pipeline/scan/pixels.h"

namespace fathom::pipeline {
namespace {

/// Floor, ceiling and nearest of x in every arithmetic that holds it.
template <class Number>
void expect_integers(double x, std::int64_t floor, std::int64_t ceiling, std::int64_t nearest) {
  const auto number = number_from<Number>(x);
  EXPECT_EQ(floor_of(number), floor) << x;
  EXPECT_EQ(ceiling_of(number), ceiling) << x;
  EXPECT_EQ(nearest_integer(number), nearest) << x;
}

TEST(Arithmetic, IntegersBesideANumber) {
  const auto expect = [](double x, std::int64_t floor, std::int64_t ceiling, std::int64_t nearest) {
    expect_integers<Exact>(x, floor, ceiling, nearest);
    expect_integers<double>(x, floor, ceiling, nearest);
    if (static_cast<double>(static_cast<float>(x)) == x) {
      expect_integers<float>(x, floor, ceiling, nearest);
    }
  };
  expect(0, 0, 0, 0);
  expect(2.25, 2, 3, 2);
  expect(-2.25, -3, -2, -2);
  expect(2.5, 2, 3, 3);  // at a tie the larger one
  expect(-2.5, -3, -2, -2);
  expect(-7, -7, -7, -7);
  expect(0x1p40 + 0.5, std::int64_t{1} << 40, (std::int64_t{1} << 40) + 1,
         (std::int64_t{1} << 40) + 1);
  expect(std::nextafter(0.5, 0), 0, 1, 0);  // x + ½ would round up to 1
  expect(std::nextafter(-0.5, -1), -1, 0, -1);
  EXPECT_EQ(floor_of(Exact(-1, 3)), -1);
  EXPECT_EQ(ceiling_of(Exact(-1, 3)), 0);
  EXPECT_EQ(nearest_integer(Exact(5, 3)), 2);
}

TEST(Arithmetic, CentresAreExactWhereTheyCanBe) {
  EXPECT_EQ(centre_of<double>(3), 3.5);
  EXPECT_EQ(centre_of<float>(-1), -0.5F);
  EXPECT_EQ(centre_of<Exact>(2147483648), Exact(4294967297.0) / Exact(2));
}

TEST(Arithmetic, QuotientsOfWideIntegersAreRoundedDown) {
  for (int a = -20; a <= 20; ++a) {
    for (int b = 1; b <= 7; ++b) {
      EXPECT_EQ(static_cast<int>(floor_quotient(a, b)),
                static_cast<int>(std::floor(double(a) / b)));
    }
  }
  const Int128 wide = Int128(1) << 100;
  EXPECT_TRUE(floor_quotient(-wide - 1, wide) == -2);
}

TEST(Pixels, SpansAreClippedToTheWindow) {
  const PixelWindow window{2, 3, 7, 9};
  EXPECT_EQ(clipped({5, 0, 20}, window), (Span{5, 2, 7}));
  EXPECT_EQ(clipped({5, 3, 4}, window), (Span{5, 3, 4}));
  for (const std::int64_t row : {2, 9}) {
    const Span none = clipped({row, 0, 20}, window);
    EXPECT_GE(none.x_begin, none.x_end);
  }
  EXPECT_TRUE(window.contains({2, 3}));
  EXPECT_FALSE(window.contains({7, 3}));
  EXPECT_FALSE(window.contains({2, 9}));
  EXPECT_TRUE(PixelWindow{}.is_unlimited());
  EXPECT_TRUE((PixelWindow{4, 0, 4, 9}.is_empty()));
}

}  // namespace
}  // namespace fathom::pipeline
