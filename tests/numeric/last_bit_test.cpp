#include <gtest/gtest.h>

#include <cmath>

#include "fathom/numeric/dyadic.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

TEST(LastBit, OfNumbersKnown) {
  EXPECT_EQ(last_bit(1.0), 0);
  EXPECT_EQ(last_bit(-12.0), 2);
  EXPECT_EQ(last_bit(0.75), -2);
  EXPECT_EQ(last_bit(0x1p1023), 1023);
  EXPECT_EQ(last_bit(5e-324), -1074);
  EXPECT_EQ(last_bit(1 + 0x1p-52), -52);
  EXPECT_EQ(last_bit(0.0), bit_of_zero);
  EXPECT_EQ(last_bit(-0.0), bit_of_zero);
  EXPECT_EQ(last_bit(Dyadic()), bit_of_zero);
  EXPECT_EQ(last_bit(Dyadic(3.0) * Dyadic(0x1p-1000) * Dyadic(0x1p-1000)), -2000);
}

/// x/2ⁿ is an integer, and an odd one.
TEST(LastBit, IsThatOfTheOddFactor) {
  std::mt19937_64 random(61);
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? checks::any_double(random) : checks::few_bits(random);
    if (x == 0) continue;
    EXPECT_EQ(last_bit(x), last_bit(Dyadic(x))) << std::hexfloat << x;
    int exponent = 0;
    const double significand = std::frexp(x, &exponent);  // x = significand·2^exponent, below 1
    const double odd = std::ldexp(significand, exponent - static_cast<int>(last_bit(x)));
    ASSERT_EQ(std::fmod(odd, 2), std::copysign(1, x)) << std::hexfloat << x;
  }
}

}  // namespace
}  // namespace fathom
