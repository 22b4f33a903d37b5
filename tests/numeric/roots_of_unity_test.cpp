#include "fathom/numeric/roots_of_unity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace fathom {
namespace {

double value_of(const Waves& waves, double turn) {
  double sum = 0;
  for (const auto& [amplitude, part] : waves)
    sum += enclose(amplitude).lower * std::cos(2 * std::numbers::pi * enclose(part).lower / turn);
  return sum;
}

TEST(RootsOfUnity, WholeTurnsAreTakenAway) {
  EXPECT_TRUE(without_whole_turns(7.5, 3.0) == Dyadic(1.5));
  EXPECT_TRUE(without_whole_turns(-1.0, 3.0) == Dyadic(2.0));
  EXPECT_TRUE(without_whole_turns(6.0, 3.0).is_zero());
  EXPECT_TRUE(without_whole_turns(0.0, 3.0).is_zero());
  const Dyadic large = Dyadic(1.0).scaled(2000), small = Dyadic(1.0).scaled(-2000);
  EXPECT_TRUE(without_whole_turns(large * Dyadic(3.0) + small, 3.0) == small);
}

// The p roots of order p add up to 0, from any angle; with another amplitude they do not.
TEST(RootsOfUnity, OfOnePrimeOrderVanish) {
  for (const int p : {2, 3, 5, 7, 11, 13}) {
    for (const double shift : {0.0, 0.25, 1.0}) {
      Waves waves;
      for (int k = 0; k < p; ++k) waves.push_back({3.0, 8.0 * k + shift});
      EXPECT_TRUE(is_zero(waves, 8.0 * p)) << p << ' ' << shift;
      waves[1].amplitude += Dyadic(1.0).scaled(-500);
      EXPECT_FALSE(is_zero(waves, 8.0 * p)) << p << ' ' << shift;
      waves[1].amplitude = 3.0;
      waves[1].part += Dyadic(1.0).scaled(-500);
      EXPECT_FALSE(is_zero(waves, 8.0 * p)) << p << ' ' << shift;
    }
  }
}

// cos 36° − cos 72° = ½; cos 20° + cos 100° + cos 140° = 0; 2·cos 60° = 1.
TEST(RootsOfUnity, KnownSumsVanish) {
  EXPECT_TRUE(is_zero({{2.0, 36.0}, {-2.0, 72.0}, {-1.0, 0.0}}, 360.0));
  EXPECT_TRUE(is_zero({{1.0, 20.0}, {1.0, 100.0}, {1.0, 140.0}}, 360.0));
  EXPECT_TRUE(is_zero({{2.0, 60.0}, {-1.0, 0.0}}, 360.0));
  EXPECT_TRUE(is_zero({}, 360.0));
  EXPECT_TRUE(is_zero({{1.0, 90.0}, {5.0, -270.0}}, 360.0));
  EXPECT_FALSE(is_zero({{2.0, 36.0}, {-2.0, 72.0}, {-1.0, 1.0}}, 360.0));
  EXPECT_FALSE(is_zero({{1.0, 45.0}, {-1.0, 30.0}}, 360.0));
}

TEST(RootsOfUnity, ProductsAreSums) {
  const Waves a{{2.0, 10.0}, {-1.0, 33.0}}, b{{1.0, 70.0}, {3.0, 5.0}};
  EXPECT_NEAR(value_of(product(a, b), 360), value_of(a, 360) * value_of(b, 360), 1e-14);
}

// Sums of few bits and orders: in binary64 a sum that is not 0 shows it.
TEST(RootsOfUnity, RandomSumsAreZeroWhereTheirValuesAre) {
  std::mt19937_64 random(7);
  const auto below = [&random](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
  };
  int zeroes = 0, others = 0;
  for (int i = 0; i < 4000; ++i) {
    const double turn = std::array{12, 30, 42, 60, 24, 10}[static_cast<std::size_t>(below(6))];
    Waves waves;
    const int count = 1 + below(5);
    for (int k = 0; k < count; ++k)
      waves.push_back({static_cast<double>(below(5) - 2), static_cast<double>(below(60))});
    const bool expected = std::abs(value_of(waves, turn)) < 1e-9;
    ASSERT_EQ(is_zero(waves, turn), expected) << i;
    ++(expected ? zeroes : others);
  }
  EXPECT_GT(zeroes, 100);
  EXPECT_GT(others, 300);
}

TEST(RootsOfUnity, TooManyAreRefused) {
  Waves waves;
  for (int k = 0; k < 31; ++k) waves.push_back({1.0, k + 0.25});
  EXPECT_THROW(is_zero(waves, 1000.0), std::logic_error);
}

}  // namespace
}  // namespace fathom
