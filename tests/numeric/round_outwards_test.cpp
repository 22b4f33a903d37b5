#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fathom/numeric/interval.h"

namespace fathom {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(RoundOutwards, KeepsBinary32Numbers) {
  for (const float x : {0.0F, -0.0F, 1.0F, -0.1F, 0x1p-149F, 0x1.fffffep127F, infinity}) {
    EXPECT_EQ(round_down(x), x);
    EXPECT_EQ(round_up(x), x);
  }
}

TEST(RoundOutwards, GoesToTheNextNumberOnItsSide) {
  EXPECT_EQ(round_down(1 + 0x1p-52), 1);
  EXPECT_EQ(round_up(1 + 0x1p-52), 1 + 0x1p-23F);
  EXPECT_EQ(round_down(-1 - 0x1p-52), -1 - 0x1p-23F);
  EXPECT_EQ(round_up(-1 - 0x1p-52), -1);
  EXPECT_EQ(round_up(0x1p-1074), 0x1p-149F);
  EXPECT_EQ(round_down(-0x1p-1074), -0x1p-149F);
  EXPECT_EQ(round_down(0x1p-1074), 0);
}

TEST(RoundOutwards, LeavesNoBinary32NumberBetween) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-4, 4);
  for (int i = 0; i < 10000; ++i) {
    const double x = std::ldexp(number(random), static_cast<int>(random() % 200) - 100);
    EXPECT_LE(round_down(x), x);
    EXPECT_GE(round_up(x), x);
    EXPECT_GT(std::nextafter(round_down(x), infinity), x);
    EXPECT_LT(std::nextafter(round_up(x), -infinity), x);
  }
}

}  // namespace
}  // namespace fathom
