#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "fathom/numeric/transcendental.h"

namespace fathom {
namespace {

TEST(Trigonometry, RationalValuesAreFound) {
  EXPECT_EQ(round_to_binary64(sine_of_degrees(0)), 0);
  EXPECT_EQ(round_to_binary64(sine_of_degrees(30)), 0.5);
  EXPECT_EQ(round_to_binary64(cosine_of_degrees(0)), 1);
  EXPECT_EQ(round_to_binary64(cotangent_of_half_degrees(90)), 1);
  EXPECT_TRUE(sine_of_degrees(30).rational().has_value());
  EXPECT_FALSE(sine_of_degrees(45).rational().has_value());
  EXPECT_FALSE(cosine_of_degrees(45).rational().has_value());
  EXPECT_FALSE(cotangent_of_half_degrees(60).rational().has_value());
  EXPECT_FALSE(cotangent_of_half_radians(1).rational().has_value());
}

// Irrational factors may have a rational product.
TEST(Trigonometry, ProductsThatAreQuartersAreExact) {
  EXPECT_EQ(round_product_to_binary64(sine_of_degrees(18), cosine_of_degrees(36)), 0.25);
  EXPECT_EQ(round_product_to_binary64(sine_of_degrees(45), cosine_of_degrees(45)), 0.5);
  EXPECT_EQ(round_product_to_binary64(sine_of_degrees(30), sine_of_degrees(30)), 0.25);
  EXPECT_EQ(round_product_to_binary64(sine_of_degrees(0), cosine_of_degrees(13)), 0);
  EXPECT_EQ(round_product_to_binary64(sine_of_degrees(15), cosine_of_degrees(15)), 0.25);
}

TEST(Trigonometry, TheEndsOfTheRangeAreRoundedOnce) {
  // tan x = x·(1 + x²/3 + …), and the cotangent of half of the least angle is beyond binary64.
  constexpr double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(round_to_binary64(cotangent_of_half_degrees(least)),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(round_to_binary64(sine_of_degrees(least)), 0);
  EXPECT_EQ(round_to_binary64(cotangent_of_half_radians(0x1p-1000)), 0x1p1001);
  EXPECT_EQ(round_to_binary64(cotangent_of_half_degrees(std::nextafter(180, 0))),
            round_to_binary64(Ratio(Dyadic(0x1p-45)) * Ratio(Dyadic(0x1.1df46a2529d39p-7))));
}

TEST(Trigonometry, RefusesOtherAngles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double degrees : {-1.0, 46.0, nan}) {
    EXPECT_THROW(sine_of_degrees(degrees), std::domain_error);
    EXPECT_THROW(cosine_of_degrees(degrees), std::domain_error);
  }
  for (const double angle : {0.0, -1.0, 180.0, nan}) {
    EXPECT_THROW(cotangent_of_half_degrees(angle), std::domain_error);
    EXPECT_THROW(cotangent_of_half_radians(angle == 180 ? 3.2 : angle), std::domain_error);
  }
}

// The digits are those of OEIS A000796.
TEST(Trigonometry, PiIsEnclosed) {
  const Enclosure around = pi().enclose(160);
  EXPECT_EQ(to_decimal(around.low, 40), to_decimal(around.high, 40));
  EXPECT_EQ(to_decimal(around.low, 40).substr(0, 41), "3.141592653589793238462643383279502884197");
  EXPECT_TRUE(around.low < around.high);
  EXPECT_EQ(round_to_binary64(pi()), std::numbers::pi);
  EXPECT_EQ(round_to_binary64(reciprocal_of_pi()), std::numbers::inv_pi);
  const Enclosure inverse = reciprocal_of_pi().enclose(160);
  EXPECT_TRUE(inverse.low < quotient(Dyadic(1.0), around.low));
  EXPECT_TRUE(quotient(Dyadic(1.0), around.high) < inverse.high);
  EXPECT_FALSE(pi().rational().has_value());
}

}  // namespace
}  // namespace fathom
