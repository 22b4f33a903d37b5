// What bounds of coordinates tell of a turn without exact numbers.
#include "fathom/clipping/boxes.h"

#include <gtest/gtest.h>

#include <random>

#include "fathom/clipping/exact_kernel.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

using P = Point2<Rational>;

std::optional<int> settled(const P& a, const P& b, const P& c) {
  return settled_sign_of_cross(box_of(a), box_of(b), box_of(c));
}

TEST(SettledSign, OfNumbersThatBinary64Has) {
  EXPECT_EQ(settled({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(settled({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(settled({0, 0}, {1, 1}, {2, 2}), 0);
}

TEST(SettledSign, OfThirds) {
  const Rational third(1, 3);
  EXPECT_EQ(settled({0, 0}, {third, 0}, {0, third}), 1);
  EXPECT_EQ(settled({0, 0}, {0, third}, {third, 0}), -1);
  // Bounds do not tell that they lie on one line.
  EXPECT_EQ(settled({0, 0}, {third, third}, {2 * third, 2 * third}), std::nullopt);
}

TEST(SettledSign, OfGreatNumbersIsLeftToExactOnes) {
  const Rational third(1, 3), great = third * Rational(0x1p600);
  EXPECT_EQ(settled({0, 0}, {great, 0}, {0, great}), std::nullopt);
  EXPECT_EQ(settled({-great, 0}, {third, 0}, {0, third}), std::nullopt);
}

TEST(SettledSign, IsThatOfExactNumbers) {
  std::mt19937 random(35);
  const auto number = [&] { return Rational(static_cast<int>(random() % 41) - 20, 7); };
  int told = 0;
  for (int i = 0; i < 3000 / checks::effort; ++i) {
    const P a{number(), number()}, b{number(), number()}, c{number(), number()};
    const auto sign = settled(a, b, c);
    if (!sign) continue;
    ++told;
    ASSERT_EQ(*sign, sign_of(cross(a, b, c)));
  }
  EXPECT_GT(told, 2000 / checks::effort);
}

}  // namespace
}  // namespace fathom::clipping::test
